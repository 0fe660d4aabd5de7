// A wooden board that rises from the ground along the actor's x axis.
#include <cmath>

#include "core/elementary.h"
#include "scenes/actors/actor.h"

namespace pbmpi::scenes {
namespace {

struct Ramp {
  double length_m, width_m, height_m, thickness_m;
  model::Material material;
};

}  // namespace

/// The board's upper face starts at the actor's origin, on the ground, and ends `length` further along and
/// `height` higher up; its foot lies below the ground, so a wheel meets no edge there.
ActorPlan read_ramp(TableReader& actor, const SceneContext&) {
  Ramp ramp{};
  ramp.length_m = actor.number("length", Sign::positive);
  ramp.width_m = actor.number("width", Sign::positive);
  ramp.height_m = actor.number("height", Sign::positive);
  ramp.thickness_m = actor.number("thickness", Sign::positive, 0.1);  // a stout plank
  ramp.material = read_material(actor, {0.7, 0});                     // rubber on dry rough wood, about 0.7
  return [ramp](const Placement& place, model::Model& model) {
    const double slope = core::angle_of(ramp.height_m, ramp.length_m);
    const double board = std::sqrt(ramp.height_m * ramp.height_m + ramp.length_m * ramp.length_m);
    const Vec3 along(core::cosine(slope), 0, core::sine(slope));
    const Vec3 normal(-core::sine(slope), 0, core::cosine(slope));
    model::Geom geom;
    geom.actor = add_actor(model, place.name, model::ActorKind::ramp);
    geom.space = place.space;
    geom.shape = model::Shape::box;
    geom.size = {board, ramp.width_m, ramp.thickness_m};
    geom.local = compose(
        place.pose, {board / 2 * along - ramp.thickness_m / 2 * normal, rotation(-slope, Vec3::UnitY())});
    geom.material = ramp.material;
    model.geoms.push_back(geom);
  };
}

}  // namespace pbmpi::scenes
