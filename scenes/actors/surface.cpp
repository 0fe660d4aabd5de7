// Static surfaces of triangles: a mesh, or a field of heights.
#include "scenes/actors/actor.h"
#include "scenes/format/shape_reader.h"

namespace pbmpi::scenes {
namespace {

ActorPlan plan_of(const geometry::PlacedMesh& placed, TableReader& actor) {
  const model::Material material = read_material(actor, {});
  const Pose frame{placed.centre, {}};
  const Quat turn = actor.rotation();
  return [mesh = placed.mesh, frame, turn, material](const Placement& place, model::Model& model) {
    model::Geom geom;
    geom.actor = add_actor(model, place.name, model::ActorKind::ground);
    geom.space = place.space;
    geom.local = compose(compose(place.pose, {Vec3::Zero(), turn}), frame);
    geom.material = material;
    geometry::put_mesh(mesh, geom);
    model.geoms.push_back(geom);
  };
}

}  // namespace

ActorPlan read_mesh_actor(TableReader& actor, const SceneContext& context) {
  const geometry::PlacedMesh placed = read_mesh_shape(actor, {context.files, context.notes});
  return plan_of(placed, actor);
}

ActorPlan read_height_field_actor(TableReader& actor, const SceneContext&) {
  const geometry::PlacedMesh placed = read_height_field(actor);
  return plan_of(placed, actor);
}

}  // namespace pbmpi::scenes
