#include "support/models.h"

#include <cmath>
#include <numbers>
#include <numeric>

namespace pbmpi::support {
namespace {

using model::JointKind;
using model::Mat3;
using model::Shape;

Mat3 diagonal(double x, double y, double z) { return Vec3(x, y, z).asDiagonal(); }

/// Inertia [kg m^2] about the centre. A capsule is treated as a cylinder of the same total length.
Mat3 solid_inertia(Shape shape, const std::array<double, 3>& size, double mass) {
  const auto [a, b, c] = size;
  if (shape == Shape::sphere) return Mat3::Identity() * (0.4 * mass * a * a);
  if (shape == Shape::box) {
    return diagonal(b * b + c * c, a * a + c * c, a * a + b * b) * (mass / 12);
  }
  const double length = shape == Shape::capsule ? b + 2 * a : b;
  const double across = mass * (3 * a * a + length * length) / 12;
  return diagonal(across, across, mass * a * a / 2);
}

}  // namespace

Quat rotation(const Vec3& axis, double angle) {
  return Quat::from_eigen(Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis)));
}

int add_actor(Model& model, const std::string& name, model::ActorKind kind, bool self_collision) {
  model.actors.push_back({name, kind, self_collision});
  return static_cast<int>(model.actors.size()) - 1;
}

int add_solid(Model& model, int actor, const std::string& name, Shape shape,
              const std::array<double, 3>& size, double mass_kg, const Vec3& position, const Quat& turn) {
  model::Body body;
  body.name = name;
  body.actor = actor;
  body.mass_kg = mass_kg;
  body.inertia = solid_inertia(shape, size, mass_kg);
  body.pose = {position, turn};
  model.bodies.push_back(body);
  model::Geom geom;
  geom.body = model.num_bodies() - 1;
  geom.actor = actor;
  geom.shape = shape;
  geom.size = size;
  model.geoms.push_back(geom);
  return geom.body;
}

std::vector<int> all_geoms(const Model& model) {
  std::vector<int> geoms(model.geoms.size());
  std::iota(geoms.begin(), geoms.end(), 0);
  return geoms;
}

int add_ground(Model& model) {
  model::Geom geom;
  geom.actor = add_actor(model, "ground", model::ActorKind::ground);
  geom.shape = Shape::plane;
  geom.material.mu = 0.8;
  model.geoms.push_back(geom);
  return static_cast<int>(model.geoms.size()) - 1;
}

int add_joint(Model& model, JointKind kind, int body_a, int body_b, const Vec3& anchor, const Vec3& axis1,
              const Vec3& axis2) {
  const auto pose_of = [&](int body) {
    return body == model::no_body ? model::Pose{} : model.bodies[body].pose;
  };
  const model::Pose a = pose_of(body_a);
  const model::Pose b = pose_of(body_b);
  const Eigen::Quaterniond to_a = a.orientation.to_eigen().conjugate();
  const Eigen::Quaterniond to_b = b.orientation.to_eigen().conjugate();
  model::Joint joint;
  joint.name = "joint" + std::to_string(model.joints.size());
  joint.kind = kind;
  joint.body_a = body_a;
  joint.body_b = body_b;
  joint.anchor_a = to_a * (anchor - a.position);
  joint.anchor_b = to_b * (anchor - b.position);
  joint.axis1_a = (to_a * axis1).normalized();
  joint.axis2_b = (to_b * axis2).normalized();
  model.joints.push_back(joint);
  return static_cast<int>(model.joints.size()) - 1;
}

Model free_box() {
  Model model;
  const int actor = add_actor(model, "box");
  const Quat turn = rotation(Vec3(1, 2, 3).normalized(), 0.7);
  const int body = add_solid(model, actor, "box", Shape::box, {2, 1, 0.5}, 3, {0, 0, 10}, turn);
  model.bodies[body].velocity = {1, 2, 3};
  model.bodies[body].angular_velocity = {0.5, 2, -1};
  return model;
}

Model box_over_ground(double height) {
  Model model;
  add_ground(model);
  const int actor = add_actor(model, "box");
  add_solid(model, actor, "box", Shape::box, {1, 1, 1}, 10, {0, 0, 0.5 + height});
  return model;
}

Model pendulum(double length, double angle) {
  Model model;
  const int actor = add_actor(model, "pendulum");
  const Vec3 position(length * std::sin(angle), 0, -length * std::cos(angle));
  const int bob = add_solid(model, actor, "bob", Shape::sphere, {0.3, 0, 0}, 1, position);
  add_joint(model, JointKind::hinge, bob, model::no_body, Vec3::Zero(), Vec3::UnitY());
  return model;
}

Model chain(int num_links) {
  Model model;
  const int actor = add_actor(model, "chain");
  const Quat along_x = rotation(Vec3::UnitY(), std::numbers::pi / 2);
  int previous = model::no_body;
  for (int i = 0; i < num_links; ++i) {
    const int link = add_solid(model, actor, "link" + std::to_string(i), Shape::capsule, {0.05, 0.4, 0}, 1,
                               {0.25 + 0.5 * i, 0, 5}, along_x);
    add_joint(model, JointKind::ball, link, previous, {0.5 * i, 0, 5});
    previous = link;
  }
  return model;
}

Model pile(int num_boxes) {
  Model model;
  add_ground(model);
  const int actor = add_actor(model, "boxes", model::ActorKind::wall, true);
  for (int i = 0; i < num_boxes; ++i) {
    const Vec3 position(0.05 * (i % 3), 0.04 * (i % 4), 0.3 + 0.55 * i);
    add_solid(model, actor, "box" + std::to_string(i), Shape::box, {0.5, 0.5, 0.5}, 2, position,
              rotation(Vec3(1, 1, 0).normalized(), 0.1 * i));
  }
  return model;
}

Model falling_balls(int a_side, double mu, int variant) {
  Model model;
  const int actor = add_actor(model, "balls", model::ActorKind::prop, true);
  for (int i = 0; i < a_side * a_side * a_side; ++i) {
    const int x = i % a_side, y = i / a_side % a_side, z = i / (a_side * a_side);
    const double shift = 0.02 * ((i * 7 + variant) % 5);
    add_solid(model, actor, "ball" + std::to_string(i), Shape::sphere, {0.3, 0, 0}, 1,
              {0.61 * x + shift, 0.61 * y - shift, 0.35 + 0.62 * z});
  }
  add_ground(model);
  for (model::Geom& geom : model.geoms) geom.material.mu = mu;
  return model;
}

}  // namespace pbmpi::support
