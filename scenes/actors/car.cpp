// A four-wheeled car: a chassis, and wheels on hinge2 joints that steer, spring and roll.
#include <cmath>
#include <numbers>
#include <string>

#include "scenes/actors/actor_builder.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {
namespace {

/// Defaults are a compact saloon of about 1.3 t.
struct Car {
  double chassis_mass_kg = 1200;
  double wheel_mass_kg = 20;                 // tyre, rim, hub and brake
  double length_m = 4.2, width_m = 1.4;      // of the body, which leaves room for the wheels at its sides
  double floor_m = 0.2, bonnet_m = 0.8;      // heights of its underside and of the bonnet above the ground
  double roof_m = 1.4;                       // height of the cabin's roof
  double wheelbase_m = 2.6, track_m = 1.62;  // distances of the wheels' centres, along and across
  double wheel_radius_m = 0.3, wheel_width_m = 0.2;
  // Passenger cars bounce at 1 to 1.5 Hz and are damped at 0.2 to 0.4 of critical (Gillespie, Fundamentals of
  // Vehicle Dynamics, ch. 5).
  double suspension_hz = 1.2, damping_ratio = 0.4;
  double wheel_break_force_n = 0;  // joint force that breaks a wheel off; 0 = unbreakable
  double speed_m_s = 0;
  double drive_torque_nm = 0;             // largest on each rear wheel, for keeping the speed
  double tyre_mu = 0.9;                   // as the ground's: dry asphalt
  model::Material body_material{0.4, 0};  // painted steel
  std::vector<std::array<double, 2>> steering;
  std::string steering_where;  ///< place in the file
  SceneContext context;
};

Car read(TableReader& actor, const SceneContext& context) {
  Car car;
  car.context = context;
  const auto positive = [&](const char* key, double& value) {
    value = actor.number(key, Sign::positive, value);
  };
  positive("chassis_mass", car.chassis_mass_kg);
  positive("wheel_mass", car.wheel_mass_kg);
  positive("length", car.length_m);
  positive("width", car.width_m);
  positive("wheelbase", car.wheelbase_m);
  positive("track", car.track_m);
  positive("wheel_radius", car.wheel_radius_m);
  positive("wheel_width", car.wheel_width_m);
  positive("suspension_frequency", car.suspension_hz);
  positive("damping_ratio", car.damping_ratio);
  car.wheel_break_force_n = actor.number("wheel_break_force", Sign::non_negative, 0.0);
  car.speed_m_s = actor.number("speed", Sign::any, 0.0);
  car.drive_torque_nm = actor.number("drive_torque", Sign::non_negative, 0.0);
  car.tyre_mu = actor.number("tyre_mu", Sign::non_negative, car.tyre_mu);
  car.body_material = read_material(actor, car.body_material);
  car.steering = actor.ascending_pairs("steering");
  car.steering_where = actor.where("steering");
  for (const auto& [time_s, angle_deg] : car.steering) {
    // Front wheels of cars turn to about 40 degrees; beyond 60 the axis would no longer steer.
    if (std::abs(angle_deg) > 60) actor.fail("steering", "steering angles must lie within 60 degrees");
  }
  if (car.wheelbase_m + 2 * car.wheel_radius_m > car.length_m) {
    actor.fail("wheelbase", "the wheels reach beyond the car's length; shorten 'wheelbase'");
  }
  return car;
}

class CarBuilder : ActorBuilder {
 public:
  CarBuilder(const Car& car, const Placement& place, model::Model& model)
      : ActorBuilder(place, model::ActorKind::car, model), car_(car) {
    // A wheel that has come off can hit the chassis and the other wheels.
    model.actors[actor_].self_collision = car.wheel_break_force_n > 0;
  }

  void build() {
    add_chassis();
    const double x = car_.wheelbase_m / 2;
    const double y = car_.track_m / 2;
    const int front_left = add_wheel("front_left", {x, y, 0}, false);
    const int front_right = add_wheel("front_right", {x, -y, 0}, false);
    add_wheel("rear_left", {-x, y, 0}, true);
    add_wheel("rear_right", {-x, -y, 0}, true);
    for (const int joint : {front_left, front_right}) add_steering(joint);
  }

 private:
  void add_chassis() {
    // The centre of mass lies in the middle of the lower box, 0.5 m above the ground, as in saloons; the
    // inertia is that of the lower box, within 10 % of measured saloons of this mass (Heydinger et al., SAE
    // 1999-01-1336: yaw about 2000 kg m^2).
    const double height = car_.bonnet_m - car_.floor_m;
    const std::array<double, 3> size = {car_.length_m, car_.width_m, height};
    const Pose middle = compose(place_.pose, {{0, 0, car_.floor_m + height / 2 - initial_depth_m}, {}});
    chassis_ = add_moving("chassis", car_.chassis_mass_kg, model::Shape::box, size, middle);
    add_geom(chassis_, model::Shape::box, size, {}, car_.body_material);
    // The cabin begins behind the bonnet and ends before the boot: the middle half of the length, slightly to
    // the rear, and narrower than the body, since windows lean inwards.
    const double cabin_height = car_.roof_m - car_.bonnet_m;
    add_geom(chassis_, model::Shape::box, {car_.length_m / 2, 0.85 * car_.width_m, cabin_height},
             {{-0.05 * car_.length_m, 0, height / 2 + cabin_height / 2}, {}}, car_.body_material);
  }

  /// `hub`: in the actor's frame, at z = 0. Returns the index of the wheel's joint.
  int add_wheel(const std::string& name, const Vec3& hub, bool driven) {
    const std::array<double, 3> size = {car_.wheel_radius_m, car_.wheel_width_m, 0};
    // A cylinder touches along its whole width, as a tyre does, and lies within the body, where a sphere
    // would bulge by its radius; ODE keeps it steady at rest, rolling and on a ramp. Cylinders lie along z;
    // the axle lies along y.
    const Pose pose = compose(place_.pose, {hub + Vec3(0, 0, car_.wheel_radius_m - initial_depth_m),
                                            rotation(std::numbers::pi / 2, Vec3::UnitX())});
    const int wheel = add_moving(name, car_.wheel_mass_kg, model::Shape::cylinder, size, pose);
    model_.bodies[wheel].angular_velocity = car_.speed_m_s / car_.wheel_radius_m * left();
    add_geom(wheel, model::Shape::cylinder, size, {}, {car_.tyre_mu, 0});
    return add_suspension(name, wheel, driven);
  }

  /// ODE measures a hinge2's angles as chassis against wheel: with axes that point down and right, a positive
  /// steering angle is a left turn, and a positive motor velocity drives forward.
  int add_suspension(const std::string& name, int wheel, bool driven) {
    const Vec3 hub = model_.bodies[wheel].pose.position;
    model::Joint& joint =
        add_joint(name + "_suspension", model::JointKind::hinge2, chassis_, wheel, hub, -up(), -left());
    const double omega = 2 * std::numbers::pi * car_.suspension_hz;
    const double quarter_mass = car_.chassis_mass_kg / 4;
    joint.suspension.stiffness = quarter_mass * omega * omega;
    joint.suspension.damping = 2 * car_.damping_ratio * quarter_mass * omega;
    // The spring exerts no force where the anchors coincide. The chassis' anchor lies below the hub by the
    // deflection under a quarter of the chassis' weight, so the car starts at rest at its ride height.
    const double weight_n = quarter_mass * std::max(0.0, -car_.context.gravity.dot(up()));
    joint.anchor_a -= weight_n / joint.suspension.stiffness * Vec3::UnitZ();
    joint.limits[0] = {0, 0};
    joint.break_force = car_.wheel_break_force_n;
    if (driven && car_.drive_torque_nm > 0) {
      joint.motors[1] = {car_.speed_m_s / car_.wheel_radius_m, car_.drive_torque_nm};
    }
    return last_joint();
  }

  /// Adds one event per step, interpolated linearly between the points of the programme.
  void add_steering(int joint) {
    for (std::size_t i = 0; i < car_.steering.size(); ++i) {
      const auto [time_s, angle_deg] = car_.steering[i];
      const std::int64_t step = step_at(time_s);
      if (i > 0) {
        const auto [before_s, before_deg] = car_.steering[i - 1];
        const std::int64_t first = step_at(before_s);
        for (std::int64_t s = first + 1; angle_deg != before_deg && s < step; ++s) {
          const double share = static_cast<double>(s - first) / static_cast<double>(step - first);
          steer(joint, s, before_deg + share * (angle_deg - before_deg));
        }
      }
      steer(joint, step, angle_deg);
    }
  }

  void steer(int joint, std::int64_t step, double angle_deg) {
    model::Event event = event_of(model::EventKind::steer, joint, step);
    event.angle = radians(angle_deg);
    add_event(model_, event);
  }

  std::int64_t step_at(double time_s) const {
    return scenes::step_at(time_s, car_.context.dt_s, car_.steering_where + ": steering");
  }

  /// A part that moves at the car's speed.
  int add_moving(const std::string& name, double mass_kg, model::Shape shape,
                 const std::array<double, 3>& size, const Pose& pose) {
    const int body = add_part(name, mass_kg, solid_inertia(shape, size, mass_kg), pose);
    model_.bodies[body].velocity += car_.speed_m_s * forward();
    return body;
  }

  const Car& car_;
  int chassis_ = 0;
};

}  // namespace

ActorPlan read_car(TableReader& actor, const SceneContext& context) {
  const Car car = read(actor, context);
  return [car](const Placement& place, model::Model& model) { CarBuilder(car, place, model).build(); };
}

}  // namespace pbmpi::scenes
