#include "model/joint_coordinates.h"

#include <cmath>
#include <numbers>

#include "model/joint_traits.h"

namespace pbmpi::model {
namespace {

Vec3 turned_back(const State& state, int body, const Vec3& direction) {
  return body == no_body
             ? direction
             : Vec3(state.orientation[static_cast<std::size_t>(body)].to_eigen().conjugate() * direction);
}

Vec3 place(const State& state, int body) {
  return body == no_body ? Vec3(Vec3::Zero()) : state.position[static_cast<std::size_t>(body)];
}

}  // namespace

std::vector<JointAxis> axes_of(const Model& model) {
  std::vector<JointAxis> axes;
  for (int joint = 0; joint < model.num_joints(); ++joint) {
    const int num_axes = traits_of(model.joints[static_cast<std::size_t>(joint)].kind).num_axes;
    for (int axis = 0; axis < num_axes; ++axis) axes.push_back({joint, axis});
  }
  return axes;
}

JointCoordinates::JointCoordinates(const Model& model) : axes_(axes_of(model)) {
  const State start = initial_state(model);
  for (const JointAxis& at : axes_) {
    const Joint& joint = model.joints[static_cast<std::size_t>(at.joint)];
    Seen seen;
    const bool is_first = at.axis == 0;
    seen.from = is_first ? joint.body_a : joint.body_b;
    seen.to = is_first ? joint.body_b : joint.body_a;
    seen.sign = is_first ? -1 : 1;
    seen.axis = is_first ? joint.axis1_a : joint.axis2_b;
    seen.slides = traits_of(joint.kind).slides;
    if (seen.slides) seen.start = length(seen, start);
    // Where a joint has two axes, one is seen to turn about the other.
    const Vec3 direction = axis_direction(start, joint, at.axis);
    const bool has_two = traits_of(joint.kind).num_axes == 2;
    Vec3 normal = has_two ? axis_direction(start, joint, 1 - at.axis) : direction.unitOrthogonal();
    normal = (normal - direction * direction.dot(normal)).normalized();
    seen.normal = turned_back(start, seen.from, normal);
    seen.mark = turned_back(start, seen.to, normal);
    seen_.push_back(seen);
  }
}

double JointCoordinates::angle(const Seen& seen, const State& state) {
  const Pose from = state.pose(seen.from), to = state.pose(seen.to);
  const Vec3 axis = from.direction_to_outer(seen.axis), normal = from.direction_to_outer(seen.normal);
  const Vec3 mark = to.direction_to_outer(seen.mark);
  return seen.sign * std::atan2(axis.dot(normal.cross(mark)), normal.dot(mark));
}

double JointCoordinates::length(const Seen& seen, const State& state) {
  return state.pose(seen.from).direction_to_outer(seen.axis).dot(place(state, seen.from) -
                                                                 place(state, seen.to)) -
         seen.start;
}

void JointCoordinates::measure(const State& state, std::span<double> coordinates) const {
  constexpr double turn = 2 * std::numbers::pi;
  const auto& counted = state.memory.joints;
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    coordinates[i] = seen_[i].slides ? length(seen_[i], state) : angle(seen_[i], state);
    if (seen_[i].slides || counted.empty()) continue;
    const auto [joint, axis] = axes_[i];
    const double known = counted[static_cast<std::size_t>(joint)].angle[static_cast<std::size_t>(axis)];
    if (known != 0) coordinates[i] += turn * std::round((known - coordinates[i]) / turn);
  }
}

Vec3 axis_direction(const State& state, const Joint& joint, int axis) {
  return axis == 0 ? state.pose(joint.body_a).direction_to_outer(joint.axis1_a)
                   : state.pose(joint.body_b).direction_to_outer(joint.axis2_b);
}

}  // namespace pbmpi::model
