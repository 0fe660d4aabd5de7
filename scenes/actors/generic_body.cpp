// One rigid body of one or several shapes, or a static obstacle.
#include "core/error.h"
#include "core/text.h"
#include "model/names.h"
#include "scenes/actors/actor.h"
#include "scenes/format/shape_reader.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {
namespace {

struct GenericBody {
  model::ActorKind kind = model::ActorKind::prop;
  std::vector<Solid> solids;
  bool is_static = false;
  MassProperties mass;
  Quat orientation;  ///< in the actor's frame
  Vec3 angular_velocity = Vec3::Zero();
  model::Material material;
};

double read_mass(TableReader& actor, const std::vector<Solid>& solids) {
  if (actor.has("mass") == actor.has("density")) {
    actor.fail("density", "give either 'mass' [kg] or 'density' [kg/m^3]");
  }
  if (actor.has("mass")) return actor.number("mass", Sign::positive);
  return actor.number("density", Sign::positive) * volume(solids);
}

/// Inertia about the centre, in the body's axes.
model::Mat3 read_inertia(TableReader& actor) {
  model::Mat3 inertia = actor.vector("inertia", Sign::positive).asDiagonal();
  if (!is_of_a_body(inertia)) {
    actor.fail("inertia", "no body has a moment of inertia above the sum of the other two; change one");
  }
  return inertia;
}

/// Composing two rotations rounds; a geom whose frame coincides with the body's keeps the frame's bits.
Pose pose_of(const Solid& solid, const Pose& frame) {
  const bool fills_frame = solid.pose.position.isZero() && solid.pose.orientation == Quat{};
  return fills_frame ? frame : compose(frame, solid.pose);
}

void build(const GenericBody& generic, const Placement& place, model::Model& model) {
  const int actor = add_actor(model, place.name, generic.kind);
  const Pose frame = compose(place.pose, {Vec3::Zero(), generic.orientation});
  int index = model::no_body;
  if (!generic.is_static) {
    model::Body body;
    body.name = place.name;
    body.actor = actor;
    body.mass_kg = generic.mass.mass_kg;
    body.inertia = generic.mass.inertia;
    body.pose = {frame.point_to_outer(generic.mass.centre), frame.orientation};
    body.velocity = place.velocity;
    body.angular_velocity = generic.angular_velocity;
    index = add_body(model, std::move(body));
  }
  for (const Solid& solid : generic.solids) {
    model::Geom geom;
    geom.body = index;
    geom.actor = actor;
    geom.space = place.space;
    geom.shape = solid.shape;
    geom.size = solid.size;
    geom.local = generic.is_static ? pose_of(solid, frame)
                                   : Pose{solid.pose.position - generic.mass.centre, solid.pose.orientation};
    geom.material = generic.material;
    geom.hull = solid.hull;
    model.geoms.push_back(geom);
  }
}

void refuse_motion(TableReader& actor) {
  auto variation = actor.table("variation");
  if (actor.has("velocity"))
    actor.fail("velocity", "a static body does not move; leave out 'velocity' or 'static'");
  if (variation && variation->has("velocity"))
    variation->fail("velocity", "a static body does not move; its velocity cannot vary");
}

ActorPlan read_generic(TableReader& actor, std::vector<Solid> solids) {
  GenericBody body;
  body.solids = std::move(solids);
  body.kind = static_cast<model::ActorKind>(actor.choice("kind", model::actor_kind_names, "prop"));
  body.is_static = actor.flag("static", false);
  body.orientation = actor.rotation();
  body.material = read_material(actor, {});
  if (body.is_static) {
    refuse_motion(actor);
  } else {
    body.mass = mass_properties(body.solids, read_mass(actor, body.solids));
    if (actor.has("inertia")) body.mass.inertia = read_inertia(actor);
    body.angular_velocity = actor.vector("angular_velocity", Sign::any, Vec3(Vec3::Zero()));
  }
  return [body](const Placement& place, model::Model& model) { build(body, place, model); };
}

Solid read_part(TableReader& geom, const SceneContext& context) {
  geom.set_what("geom of a compound");
  Solid solid = read_solid_shape(geom, read_shape(geom, solid_shapes()), {context.files, context.notes});
  const Pose frame{geom.vector("position", Sign::any, Vec3(Vec3::Zero())), geom.rotation()};
  solid.pose =
      solid.hull == nullptr ? frame : Pose{frame.point_to_outer(solid.pose.position), frame.orientation};
  geom.finish();
  return solid;
}

}  // namespace

ActorPlan read_solid(TableReader& actor, const SceneContext& context) {
  const model::Shape shape = *model::enum_from_name<model::Shape>(actor.text("type"), model::shape_names);
  return read_generic(actor, {read_solid_shape(actor, shape, {context.files, context.notes})});
}

ActorPlan read_compound(TableReader& actor, const SceneContext& context) {
  std::vector<Solid> solids;
  for (TableReader& geom : actor.tables("geoms")) solids.push_back(read_part(geom, context));
  if (solids.empty()) actor.fail("geoms", "'geoms' is missing or empty; give at least one { shape = ... }");
  return read_generic(actor, std::move(solids));
}

}  // namespace pbmpi::scenes
