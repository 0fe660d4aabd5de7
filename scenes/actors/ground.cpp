// A level, endless ground.
#include "scenes/actors/actor.h"

namespace pbmpi::scenes {
namespace {

// Rubber on dry asphalt reaches about 0.9 (Wong, Theory of Ground Vehicles, table of road adhesion). A pair
// takes the geometric mean of its two materials, so tyre and road both have the pair's value.
constexpr double dry_asphalt_mu = 0.9;

}  // namespace

ActorPlan read_ground(TableReader& actor, const SceneContext&) {
  const model::Material material = read_material(actor, {dry_asphalt_mu, 0});
  return [material](const Placement& place, model::Model& model) {
    model::Geom geom;
    geom.actor = add_actor(model, place.name, model::ActorKind::ground);
    geom.space = place.space;
    geom.shape = model::Shape::plane;
    geom.local = place.pose;
    geom.material = material;
    model.geoms.push_back(geom);
  };
}

}  // namespace pbmpi::scenes
