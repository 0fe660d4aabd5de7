// A centipede: a chain of segments on universal joints, each with a pair of driven legs.
#include <numbers>
#include <string>

#include "core/elementary.h"
#include "scenes/actors/actor_builder.h"
#include "scenes/parts/mass_properties.h"

namespace pbmpi::scenes {
namespace {

/// Defaults are a monster as tall as a man and of a car's length: 8 segments of 0.6 m.
struct Centipede {
  int num_segments = 8;
  double segment_length_m = 0.6, segment_width_m = 0.5, segment_height_m = 0.3;
  double ride_height_m = 0.45;                     // of the segments' middle above the ground
  double leg_radius_m = 0.05, leg_reach_m = 0.45;  // the foot's distance from the segment's side
  double density_kg_m3 = 1000;                     // flesh, about water's
  double stride_s = 0.5;                           // period of the legs' swing
  double walk_s = 2;                               // how long the legs swing; then they hold
  double torque_nm = 400;                          // of each of a leg's two motors
  model::Material material{0.8, 0};
  double dt_s = 0.01;
  std::string where;  ///< place in the file
};

constexpr double gap_m = 0.05;          // between segments, lets them bend
constexpr double most_bend_deg = 30;    // of a joint between segments, to each side
constexpr double back_torque_nm = 600;  // holds the back straight: a segment's weight at three lengths
constexpr double reach_deg = 20, lift_deg = 12;  // of a leg fore and aft, and up

class CentipedeBuilder : ActorBuilder {
 public:
  CentipedeBuilder(const Centipede& centipede, const Placement& place, model::Model& model)
      : ActorBuilder(place, model::ActorKind::centipede, model), c_(centipede) {}

  void build() {
    int before = model::no_body;
    for (int i = 0; i < c_.num_segments; ++i) {
      const double x = -i * (c_.segment_length_m + gap_m);
      const int segment = add_segment(i, x);
      if (before != model::no_body) add_back_joint(i, before, segment, x);
      for (const int side : {1, -1}) add_leg(i, segment, x, side);
      before = segment;
    }
  }

 private:
  int add_segment(int number, double x) {
    const std::array<double, 3> size = {c_.segment_length_m, c_.segment_width_m, c_.segment_height_m};
    const Pose pose{{x, 0, c_.ride_height_m - initial_depth_m}, {}};
    return add_solid("segment" + std::to_string(number + 1), model::Shape::box, size, pose);
  }

  void add_back_joint(int number, int before, int segment, double x) {
    const Vec3 middle = at({x + (c_.segment_length_m + gap_m) / 2, 0, c_.ride_height_m - initial_depth_m});
    model::Joint& joint = add_joint("back" + std::to_string(number), model::JointKind::universal, before,
                                    segment, middle, up(), left());
    for (int axis = 0; axis < 2; ++axis) {
      joint.limits[axis] = {-radians(most_bend_deg), radians(most_bend_deg)};
      joint.motors[axis] = {0, back_torque_nm};
    }
  }

  /// A capsule from the segment's flank down and out to the ground.
  void add_leg(int number, int segment, double x, int side) {
    const double rise = c_.ride_height_m - c_.leg_radius_m;
    const Vec3 hip(x, side * c_.segment_width_m / 2, c_.ride_height_m - initial_depth_m);
    const Vec3 foot = hip + Vec3(0, side * c_.leg_reach_m, -rise);
    const double angle = side * core::angle_of(c_.leg_reach_m, rise);  // from straight down, about x
    const std::array<double, 3> size = {c_.leg_radius_m, (foot - hip).norm(), 0};
    const std::string name = (side > 0 ? "left_leg" : "right_leg") + std::to_string(number + 1);
    const int leg =
        add_solid(name, model::Shape::capsule, size, {(hip + foot) / 2, rotation(angle, Vec3::UnitX())});
    // Axis 1 swings the leg fore and aft, axis 2 lifts it. ODE measures the segment's turn against the leg's:
    // with these axes a positive angle is a swing forward, or a lift.
    model::Joint& joint = add_joint(name + "_hip", model::JointKind::universal, segment, leg, at(hip),
                                    side * up(), -side * forward());
    joint.limits[0] = {-radians(reach_deg), radians(reach_deg)};
    joint.limits[1] = {-radians(lift_deg), radians(lift_deg)};
    joint.motors[0] = joint.motors[1] = {0, c_.torque_nm};
    const bool first_group = (number + (side > 0 ? 0 : 1)) % 2 == 0;
    add_gait(last_joint(), first_group);
  }

  /// Alternating groups of legs, as in insects: in one half of the stride a group is lifted and swings
  /// forward, in the other half it stands and pushes back. Each quarter of a swing has constant speed.
  void add_gait(int joint, bool first_group) {
    const auto half = std::max<std::int64_t>(2, step_at(c_.stride_s / 2, c_.dt_s, c_.where + ": stride"));
    const std::int64_t end = step_at(c_.walk_s, c_.dt_s, c_.where + ": walk");
    const double half_s = static_cast<double>(half) * c_.dt_s;
    const double swing_speed = radians(reach_deg) / half_s;
    const double lift_speed = 2 * radians(lift_deg) / 2 / half_s;
    bool ahead = first_group;
    for (std::int64_t step = 0; step < end; step += half, ahead = !ahead) {
      drive(joint, 0, step, ahead ? swing_speed : -swing_speed);
      drive(joint, 1, step, ahead ? lift_speed : -lift_speed);
      drive(joint, 1, step + half / 2, ahead ? -lift_speed : 0);
    }
    drive(joint, 0, end, 0);
    drive(joint, 1, end, 0);
  }

  void drive(int joint, int axis, std::int64_t step, double speed_rad_s) {
    model::Event event = event_of(model::EventKind::motor, joint, step);
    event.axis = axis;
    event.motor = {speed_rad_s, c_.torque_nm, 0};
    add_event(model_, event);
  }

  int add_solid(const std::string& name, model::Shape shape, const std::array<double, 3>& size,
                const Pose& pose) {
    const double mass_kg = c_.density_kg_m3 * volume(shape, size);
    const int body = add_part(name, mass_kg, solid_inertia(shape, size, mass_kg), compose(place_.pose, pose));
    add_geom(body, shape, size, {}, c_.material);
    return body;
  }

  const Centipede& c_;
};

}  // namespace

ActorPlan read_centipede(TableReader& actor, const SceneContext& context) {
  Centipede centipede;
  centipede.dt_s = context.dt_s;
  centipede.where = actor.where();
  centipede.num_segments = actor.integer("segments", 1, centipede.num_segments);
  centipede.stride_s = actor.number("stride", Sign::positive, centipede.stride_s);
  centipede.walk_s = actor.number("walk", Sign::non_negative, centipede.walk_s);
  centipede.torque_nm = actor.number("torque", Sign::positive, centipede.torque_nm);
  centipede.material = read_material(actor, centipede.material);
  return [centipede](const Placement& place, model::Model& model) {
    CentipedeBuilder(centipede, place, model).build();
  };
}

}  // namespace pbmpi::scenes
