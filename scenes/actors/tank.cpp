// A battle tank at rest: hull with its two tracks, turret and barrel.
#include <numbers>
#include <string>

#include "scenes/actors/actor_builder.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {
namespace {

/// Defaults are a main battle tank of about 54 t (Leopard 2: 7.7 m hull, 3.7 m wide, 2.5 m roof; turret with
/// gun about 16 t).
struct Tank {
  double hull_mass_kg = 38000, turret_mass_kg = 14000, barrel_mass_kg = 2000;
  double length_m = 7.5, width_m = 3.6;  // over the tracks
  double track_width_m = 0.6, track_height_m = 0.9;
  double ground_clearance_m = 0.5, deck_m = 1.6;  // heights of the hull's underside and of its deck
  double turret_length_m = 3.6, turret_width_m = 2.6, turret_height_m = 0.8;
  double barrel_length_m = 5.0, barrel_radius_m = 0.16;
  double turret_deg = 0, elevation_deg = 0;  // direction of the gun relative to the hull
  model::Material material{0.7, 0};          // rubber pads and steel on the ground
};

// The drives hold the gun against any blow in the scenes: four times the barrel's weight at its middle. The
// turret's ring has the same torque.
constexpr double elevation_torque_nm = 2e5;
constexpr double traverse_torque_nm = 2e5;

class TankBuilder : ActorBuilder {
 public:
  TankBuilder(const Tank& tank, const Placement& place, model::Model& model)
      : ActorBuilder(place, model::ActorKind::tank, model), tank_(tank) {}

  void build() {
    const int hull = add_hull();
    const Pose ring =
        compose(place_.pose, {{0, 0, tank_.deck_m}, rotation(radians(tank_.turret_deg), Vec3::UnitZ())});
    const int turret = add_turret(ring);
    const Pose trunnion = compose(ring, {{tank_.turret_length_m / 2, 0, tank_.turret_height_m / 2},
                                         rotation(-radians(tank_.elevation_deg), Vec3::UnitY())});
    const int barrel = add_barrel(trunnion);
    hold("traverse", hull, turret, ring.position, ring.direction_to_outer(Vec3::UnitZ()), traverse_torque_nm);
    hold("elevation", turret, barrel, trunnion.position, ring.direction_to_outer(Vec3::UnitY()),
         elevation_torque_nm);
  }

 private:
  /// Tracks that do not move are two long feet: part of the hull.
  int add_hull() {
    const double belly_height = tank_.deck_m - tank_.ground_clearance_m;
    const double belly_width = tank_.width_m - 2 * tank_.track_width_m;
    const std::array<double, 3> belly = {tank_.length_m, belly_width, belly_height};
    const double middle = tank_.ground_clearance_m + belly_height / 2 - initial_depth_m;
    const int hull = add_box("hull", tank_.hull_mass_kg, belly, compose(place_.pose, {{0, 0, middle}, {}}));
    add_geom(hull, model::Shape::box, belly, {}, tank_.material);
    for (const int side : {1, -1}) {
      const double y = side * (tank_.width_m - tank_.track_width_m) / 2;
      add_geom(hull, model::Shape::box, {0.9 * tank_.length_m, tank_.track_width_m, tank_.track_height_m},
               {{0, y, tank_.track_height_m / 2 - initial_depth_m - middle}, {}}, tank_.material);
    }
    return hull;
  }

  int add_turret(const Pose& ring) {
    const std::array<double, 3> size = {tank_.turret_length_m, tank_.turret_width_m, tank_.turret_height_m};
    const int turret =
        add_box("turret", tank_.turret_mass_kg, size, compose(ring, {{0, 0, tank_.turret_height_m / 2}, {}}));
    add_geom(turret, model::Shape::box, size, {}, tank_.material);
    return turret;
  }

  /// The barrel body's x axis points to the muzzle, from which a projectile finds where it leaves.
  int add_barrel(const Pose& trunnion) {
    const std::array<double, 3> size = {tank_.barrel_length_m, 2 * tank_.barrel_radius_m,
                                        2 * tank_.barrel_radius_m};
    const int barrel = add_box("barrel", tank_.barrel_mass_kg, size,
                               compose(trunnion, {{tank_.barrel_length_m / 2, 0, 0}, {}}));
    add_geom(barrel, model::Shape::cylinder, {tank_.barrel_radius_m, tank_.barrel_length_m, 0},
             {Vec3::Zero(), rotation(std::numbers::pi / 2, Vec3::UnitY())}, tank_.material);
    return barrel;
  }

  /// A part with the inertia of a solid box.
  int add_box(const std::string& name, double mass_kg, const std::array<double, 3>& box, const Pose& pose) {
    return add_part(name, mass_kg, solid_inertia(model::Shape::box, box, mass_kg), pose);
  }

  /// A drive at rest: its motor holds the angle.
  void hold(const std::string& name, int inner, int outer, const Vec3& anchor, const Vec3& axis,
            double torque_nm) {
    model::Joint& joint = add_joint(name, model::JointKind::hinge, inner, outer, anchor, axis);
    joint.limits[0] = {0, 0};
    joint.motors[0] = {0, torque_nm};
  }

  const Tank& tank_;
};

}  // namespace

ActorPlan read_tank(TableReader& actor, const SceneContext&) {
  Tank tank;
  const auto positive = [&](const char* key, double& value) {
    value = actor.number(key, Sign::positive, value);
  };
  positive("hull_mass", tank.hull_mass_kg);
  positive("turret_mass", tank.turret_mass_kg);
  positive("barrel_mass", tank.barrel_mass_kg);
  positive("barrel_length", tank.barrel_length_m);
  positive("barrel_radius", tank.barrel_radius_m);
  tank.turret_deg = actor.number("turret", Sign::any, 0.0);
  tank.elevation_deg = actor.number("elevation", Sign::any, 0.0);
  // Tank guns move between about -9 and 20 degrees.
  if (tank.elevation_deg < -10 || tank.elevation_deg > 20) {
    actor.fail("elevation", "'elevation' must lie in -10 to 20 degrees");
  }
  tank.material = read_material(actor, tank.material);
  return [tank](const Placement& place, model::Model& model) { TankBuilder(tank, place, model).build(); };
}

}  // namespace pbmpi::scenes
