// Projectiles: bodies that exist from the start, and that a tank fires at a given time.
#include <array>
#include <numbers>
#include <string>

#include "core/error.h"
#include "core/text.h"
#include "scenes/actors/actor.h"
#include "scenes/format/shape_reader.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {
namespace {

struct Shot {
  std::string tank;       ///< name of the actor that fires; empty: the projectile stays where it lies
  std::string where;      ///< place of that name in the file
  double first_s = 0;     ///< when copy 0 leaves the muzzle; ...
  double interval_s = 0;  ///< ... each further copy follows after this interval
  double speed_m_s = 0;
  double azimuth_deg = 0, elevation_deg = 0;  ///< against the barrel, to the left and up
};

struct Projectile {
  model::Shape shape = model::Shape::sphere;
  std::array<double, 3> size{};
  double mass_kg = 0;
  model::Material material{0.5, 0};  // steel on stone
  Shot shot;
  double dt_s = 0.01;
};

constexpr std::array shapes = {model::Shape::sphere, model::Shape::cylinder, model::Shape::box};

/// Half of the extent along z as it lies, and along x as it flies (a cylinder flies axis first).
double half_height(const Projectile& p) {
  if (p.shape == model::Shape::sphere) return p.size[0];
  return (p.shape == model::Shape::cylinder ? p.size[1] : p.size[2]) / 2;
}
double half_length(const Projectile& p) {
  return p.shape == model::Shape::box ? p.size[0] / 2 : half_height(p);
}

/// The muzzle: the end of the barrel's only geom, with x pointing forward.
Pose muzzle(const Projectile& projectile, GrowingModel& model) {
  const Shot& shot = projectile.shot;
  const std::optional<int> barrel = model.find_body(shot.tank + ".barrel");
  core::require_input(barrel.has_value(), shot.where + ": no tank " + core::in_quotes(shot.tank) +
                                              " stands above this actor in the file; place it there");
  const model::Geom* geom = model.geom_of(*barrel);
  core::require_invariant(geom != nullptr, "a barrel without a geom");
  // A hand's breadth beyond the barrel.
  const double ahead = geom->size[1] / 2 + half_length(projectile) + 0.1;
  const Quat aim = compose({{}, rotation(radians(shot.azimuth_deg), Vec3::UnitZ())},
                           {{}, rotation(-radians(shot.elevation_deg), Vec3::UnitY())})
                       .orientation;
  return compose(model.bodies[*barrel].pose, {Vec3(ahead, 0, 0), aim});
}

model::Event launch(const Projectile& projectile, int body, int copy, GrowingModel& model) {
  const Shot& shot = projectile.shot;
  const Pose start = muzzle(projectile, model);
  model::Event event;
  event.kind = model::EventKind::launch;
  event.step = step_at(shot.first_s + copy * shot.interval_s, projectile.dt_s, shot.where + ": shot");
  event.body = body;
  event.velocity = shot.speed_m_s * start.direction_to_outer(Vec3::UnitX());
  const bool lies_along_z = projectile.shape == model::Shape::cylinder;
  const Quat ahead = lies_along_z ? rotation(std::numbers::pi / 2, Vec3::UnitY()) : Quat{};
  event.pose = compose(start, {Vec3::Zero(), ahead});
  return event;
}

void build(const Projectile& projectile, const Placement& place, GrowingModel& model) {
  model::Body body;
  body.name = place.name;
  body.actor = add_actor(model, place.name, model::ActorKind::projectile);
  body.mass_kg = projectile.mass_kg;
  body.inertia = solid_inertia(projectile.shape, projectile.size, body.mass_kg);
  body.pose = compose(place.pose, {{0, 0, half_height(projectile) - initial_depth_m}, {}});
  body.velocity = place.velocity;
  model::Geom geom{model::no_body,  body.actor, place.space,        projectile.shape,
                   projectile.size, {},         projectile.material};
  geom.body = add_body(model, std::move(body));
  model.geoms.push_back(geom);
  if (!projectile.shot.tank.empty()) {
    add_event(model, launch(projectile, geom.body, place.copy, model));
  }
}

void read_shot(TableReader& actor, Shot& shot) {
  if (!actor.has("fired_by")) return;
  shot.tank = actor.text("fired_by");
  shot.where = actor.where("fired_by");
  shot.speed_m_s = actor.number("muzzle_speed", Sign::positive);
  shot.first_s = actor.number("first_shot", Sign::non_negative);
  shot.interval_s = actor.number("interval", Sign::positive, 0.1);
  shot.azimuth_deg = actor.number("azimuth", Sign::any, 0.0);
  shot.elevation_deg = actor.number("elevation", Sign::any, 0.0);
}

}  // namespace

ActorPlan read_projectile(TableReader& actor, const SceneContext& context) {
  Projectile projectile;
  projectile.dt_s = context.dt_s;
  projectile.shape = read_shape(actor, shapes);
  projectile.size = read_size(actor, projectile.shape);
  projectile.mass_kg = actor.number("density", Sign::positive) * volume(projectile.shape, projectile.size);
  projectile.material = read_material(actor, projectile.material);
  read_shot(actor, projectile.shot);
  return [projectile](const Placement& place, GrowingModel& model) { build(projectile, place, model); };
}

}  // namespace pbmpi::scenes
