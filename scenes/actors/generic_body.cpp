// One rigid body of one shape, or a static obstacle of that shape.
#include "core/error.h"
#include "core/text.h"
#include "model/names.h"
#include "scenes/actors/actor.h"
#include "scenes/format/rotation_reader.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {
namespace {

struct GenericBody {
  model::ActorKind kind = model::ActorKind::prop;
  model::Shape shape = model::Shape::box;
  std::array<double, 3> size{};
  bool is_static = false;
  double mass_kg = 0;
  model::Mat3 inertia = model::Mat3::Identity();
  Quat orientation;  ///< in the actor's frame
  Vec3 angular_velocity = Vec3::Zero();
  model::Material material;
};

model::ActorKind read_kind(TableReader& actor) {
  const std::string name = actor.text("kind", "prop");
  const auto kind = model::enum_from_name<model::ActorKind>(name, model::actor_kind_names);
  if (kind) return *kind;
  const auto& names = model::actor_kind_names;
  actor.fail("kind",
             "unknown kind " + core::in_quotes(name) + core::suggestion(name, {names.begin(), names.end()}));
}

double read_mass(TableReader& actor, model::Shape shape, const std::array<double, 3>& size) {
  if (actor.has("mass") == actor.has("density")) {
    actor.fail("density", "give either 'mass' [kg] or 'density' [kg/m^3]");
  }
  if (actor.has("mass")) return actor.number("mass", Sign::positive);
  return actor.number("density", Sign::positive) * volume(shape, size);
}

/// About the centre, in the body's axes. No mass distribution has a moment above the sum of the other two.
model::Mat3 read_inertia(TableReader& actor) {
  const Vec3 moments = actor.vector("inertia", Sign::positive);
  constexpr double rounding = 1e-9;  // of a flat body's digits, for which the two are equal
  if (2 * moments.maxCoeff() > (1 + rounding) * moments.sum()) {
    actor.fail("inertia", "no body has a moment of inertia above the sum of the other two; change one");
  }
  return moments.asDiagonal();
}

void build(const GenericBody& part, const Placement& place, model::Model& model) {
  model::Geom geom;
  geom.actor = add_actor(model, place.name, part.kind);
  geom.space = place.space;
  geom.shape = part.shape;
  geom.size = part.size;
  geom.material = part.material;
  const Pose pose = compose(place.pose, {Vec3::Zero(), part.orientation});
  if (part.is_static) {
    geom.local = pose;
  } else {
    model::Body body;
    body.name = place.name;
    body.actor = geom.actor;
    body.mass_kg = part.mass_kg;
    body.inertia = part.inertia;
    body.pose = pose;
    body.velocity = place.velocity;
    body.angular_velocity = part.angular_velocity;
    geom.body = add_body(model, std::move(body));
  }
  model.geoms.push_back(geom);
}

void refuse_motion(TableReader& actor) {
  auto variation = actor.table("variation");
  if (actor.has("velocity"))
    actor.fail("velocity", "a static body does not move; leave out 'velocity' or 'static'");
  if (variation && variation->has("velocity"))
    variation->fail("velocity", "a static body does not move; its velocity cannot vary");
}

ActorPlan read_generic(TableReader& actor, model::Shape shape, const std::array<double, 3>& size) {
  GenericBody part;
  part.shape = shape;
  part.size = size;
  part.kind = read_kind(actor);
  part.is_static = actor.flag("static", false);
  part.orientation = read_rotation(actor);
  part.material = read_material(actor, {});
  if (part.is_static) {
    refuse_motion(actor);
  } else {
    part.mass_kg = read_mass(actor, shape, size);
    part.inertia = actor.has("inertia") ? read_inertia(actor) : solid_inertia(shape, size, part.mass_kg);
    part.angular_velocity = actor.vector("angular_velocity", Sign::any, Vec3(Vec3::Zero()));
  }
  return [part](const Placement& place, model::Model& model) { build(part, place, model); };
}

}  // namespace

ActorPlan read_box(TableReader& actor, const SceneContext&) {
  const Vec3 size = actor.vector("size", Sign::positive);
  return read_generic(actor, model::Shape::box, {size.x(), size.y(), size.z()});
}

ActorPlan read_sphere(TableReader& actor, const SceneContext&) {
  return read_generic(actor, model::Shape::sphere, {actor.number("radius", Sign::positive)});
}

ActorPlan read_capsule(TableReader& actor, const SceneContext&) {
  const double radius = actor.number("radius", Sign::positive);
  return read_generic(actor, model::Shape::capsule, {radius, actor.number("length", Sign::positive)});
}

ActorPlan read_cylinder(TableReader& actor, const SceneContext&) {
  const double radius = actor.number("radius", Sign::positive);
  return read_generic(actor, model::Shape::cylinder, {radius, actor.number("length", Sign::positive)});
}

}  // namespace pbmpi::scenes
