#include "scenes/parts/parts.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "core/elementary.h"
#include "core/error.h"

namespace pbmpi::scenes {
namespace {

/// Most bodies or events that a world may have.
constexpr std::size_t most_things = 4'000'000;

Pose pose_of(const model::Model& model, int body) {
  return body == model::no_body ? Pose{} : model.bodies[body].pose;
}

Vec3 point_to_inner(const Pose& pose, const Vec3& point) {
  return pose.orientation.to_eigen().conjugate() * (point - pose.position);
}

Vec3 direction_to_inner(const Pose& pose, const Vec3& direction) {
  return (pose.orientation.to_eigen().conjugate() * direction).normalized();
}

}  // namespace

Pose compose(const Pose& outer, const Pose& inner) {
  const Eigen::Quaterniond q = outer.orientation.to_eigen() * inner.orientation.to_eigen();
  return {outer.point_to_outer(inner.position), Quat::from_eigen(q.normalized())};
}

Quat rotation(double angle_rad, const Vec3& axis) {
  const Vec3 vector = core::sine(angle_rad / 2) * axis;
  return {core::cosine(angle_rad / 2), vector.x(), vector.y(), vector.z()};
}

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

std::int64_t step_at(double time_s, double dt_s, const std::string& where) {
  constexpr double most_steps = 9007199254740992;  // 2^53: beyond it a double cannot tell two steps apart
  const double step = std::round(time_s / dt_s);
  if (!(std::abs(step) <= most_steps)) {
    std::ostringstream text;
    text << where << ": the time " << time_s << " s is more than 2^53 steps of " << dt_s
         << " s away, and no run gets there; give an earlier one";
    throw core::InputError(text.str());
  }
  return static_cast<std::int64_t>(step);
}

void add_event(model::Model& model, const model::Event& event) {
  if (model.events.size() >= most_things)
    throw std::length_error(
        "the world has more than 4,000,000 events; shorten what its actors do at given times, or take longer "
        "steps");
  model.events.push_back(event);
}

int add_actor(model::Model& model, std::string name, model::ActorKind kind) {
  model.actors.push_back({std::move(name), kind, false});
  return static_cast<int>(model.actors.size()) - 1;
}

int add_body(model::Model& model, model::Body body) {
  if (model.bodies.size() >= most_things)
    throw std::length_error("the world has more than 4,000,000 bodies; place fewer");
  model.bodies.push_back(std::move(body));
  return model.num_bodies() - 1;
}

void attach(const model::Model& model, int a, int b, const Vec3& anchor, const Vec3& axis1, const Vec3& axis2,
            model::Joint& joint) {
  const Pose pose_a = pose_of(model, a);
  const Pose pose_b = pose_of(model, b);
  joint.body_a = a;
  joint.body_b = b;
  joint.anchor_a = point_to_inner(pose_a, anchor);
  joint.anchor_b = point_to_inner(pose_b, anchor);
  joint.axis1_a = direction_to_inner(pose_a, axis1);
  joint.axis2_b = direction_to_inner(pose_b, axis2);
}

model::Joint join(const model::Model& model, std::string name, model::JointKind kind, int a, int b,
                  const Vec3& anchor, const Vec3& axis1, const Vec3& axis2) {
  model::Joint joint;
  joint.name = std::move(name);
  joint.kind = kind;
  attach(model, a, b, anchor, axis1, axis2, joint);
  return joint;
}

}  // namespace pbmpi::scenes
