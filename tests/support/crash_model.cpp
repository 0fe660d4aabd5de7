/// The crash-like model: sizes and masses are round numbers, not those of the scene CrashSk.
#include <numbers>

#include "support/models.h"

namespace pbmpi::support {
namespace {

using model::JointKind;
using model::Shape;

constexpr double pi = std::numbers::pi;

void limit(Model& model, int joint, int axis, double low, double high) {
  model.joints[joint].limits[axis] = {low, high};
}

/// Two segments, one hanging below the other, at x = y = const.
struct Limb {
  int upper, lower, end;
};

class Ragdoll {
 public:
  Ragdoll(Model& model, const std::string& name, const Vec3& feet)
      : model_(&model), name_(name), feet_(feet), actor_(add_actor(model, name, model::ActorKind::human)) {
    const int pelvis = add("pelvis", Shape::box, {0.2, 0.35, 0.2}, 11, {0, 0, 1.0});
    const int waist = add("waist", Shape::box, {0.2, 0.3, 0.15}, 11, {0, 0, 1.18});
    const int chest = add("chest", Shape::box, {0.22, 0.35, 0.25}, 16, {0, 0, 1.38});
    const int head = add("head", Shape::sphere, {0.1, 0, 0}, 5, {0, 0, 1.65});
    join(JointKind::fixed, waist, pelvis, {0, 0, 1.1});
    const int spine = join(JointKind::universal, chest, waist, {0, 0, 1.25}, Vec3::UnitX(), Vec3::UnitY());
    limit(model, spine, 0, -0.3, 0.3);
    limit(model, spine, 1, -0.8, 0.3);
    model.joints[spine].motors[0] = {0, 5};
    join(JointKind::ball, head, chest, {0, 0, 1.53});
    for (const double side : {-1.0, 1.0}) {
      add_leg(pelvis, side);
      add_arm(chest, side);
    }
  }

 private:
  int add(const std::string& part, Shape shape, const std::array<double, 3>& size, double mass,
          const Vec3& at) {
    return add_solid(*model_, actor_, name_ + "." + part, shape, size, mass, feet_ + at);
  }
  int join(JointKind kind, int a, int b, const Vec3& anchor, const Vec3& axis1 = Vec3::UnitY(),
           const Vec3& axis2 = Vec3::UnitX()) {
    return add_joint(*model_, kind, a, b, feet_ + anchor, axis1, axis2);
  }
  void add_leg(int pelvis, double side) {
    const double y = 0.1 * side;
    const std::string which = side < 0 ? "right_" : "left_";
    const int thigh = add(which + "thigh", Shape::capsule, {0.07, 0.3, 0}, 8, {0, y, 0.7});
    const int shin = add(which + "shin", Shape::capsule, {0.05, 0.3, 0}, 4, {0, y, 0.3});
    const int foot = add(which + "foot", Shape::box, {0.25, 0.09, 0.08}, 1, {0.05, y, 0.041});
    join(JointKind::ball, thigh, pelvis, {0, y, 0.92});
    const int knee = join(JointKind::hinge, shin, thigh, {0, y, 0.5});
    limit(*model_, knee, 0, 0, 2.4);
    model_->joints[knee].motors[0] = {0, 20};
    const int ankle = join(JointKind::universal, foot, shin, {0, y, 0.09});
    limit(*model_, ankle, 0, -0.5, 0.7);
    limit(*model_, ankle, 1, -0.3, 0.3);
  }
  void add_arm(int chest, double side) {
    const double y = 0.24 * side;
    const std::string which = side < 0 ? "right_" : "left_";
    const int upper = add(which + "upper_arm", Shape::capsule, {0.04, 0.22, 0}, 2, {0, y, 1.33});
    const int lower = add(which + "forearm", Shape::capsule, {0.035, 0.2, 0}, 1.2, {0, y, 1.05});
    const int hand = add(which + "hand", Shape::box, {0.04, 0.08, 0.16}, 0.5, {0, y, 0.83});
    join(JointKind::ball, upper, chest, {0, y, 1.47});
    limit(*model_, join(JointKind::hinge, lower, upper, {0, y, 1.18}), 0, -2.4, 0);
    limit(*model_, join(JointKind::hinge, hand, lower, {0, y, 0.92}), 0, -1, 1);
  }

  Model* model_;
  std::string name_;
  Vec3 feet_;
  int actor_;
};

void add_car(Model& model, double speed) {
  const int actor = add_actor(model, "car", model::ActorKind::car);
  const double radius = 0.35;
  const int chassis = add_solid(model, actor, "car.chassis", Shape::box, {4, 1.6, 0.8}, 1200, {-2, 0, 0.75});
  const Quat across = rotation(Vec3::UnitX(), pi / 2);
  for (int i = 0; i < 4; ++i) {
    const Vec3 hub(i < 2 ? -0.6 : -3.4, i % 2 == 0 ? -0.85 : 0.85, radius);
    const int wheel =
        add_solid(model, actor, "car.wheel" + std::to_string(i), Shape::cylinder, {radius, 0.2, 0}, 20, hub);
    model.geoms.back().local.orientation = across;  // turns the geom to the axle, but not the body
    model.bodies[wheel].inertia = Vec3(0.68, 1.22, 0.68).asDiagonal();
    const int joint = add_joint(model, JointKind::hinge2, chassis, wheel, hub, Vec3::UnitZ(), Vec3::UnitY());
    model.joints[joint].suspension = {40000, 4000};
    limit(model, joint, 0, 0, 0);
    model.bodies[wheel].angular_velocity = {0, speed / radius, 0};
  }
  for (model::Body& body : model.bodies) body.velocity = {speed, 0, 0};
}

}  // namespace

Model crash(int variant) {
  Model model;
  add_car(model, 25);
  const double shift = 0.01 * variant;
  const Ragdoll near_one(model, "human0", {3 + shift, -0.3, 0});
  const Ragdoll far_one(model, "human1", {3.6, 0.35 - shift, 0});
  add_ground(model);
  return model;
}

}  // namespace pbmpi::support
