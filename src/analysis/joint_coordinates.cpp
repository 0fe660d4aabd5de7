#include "analysis/joint_coordinates.h"

#include <cmath>
#include <numbers>

#include "core/elementary.h"
#include "model/joint_traits.h"

namespace pbmpi::analysis {
namespace {

model::Vec3 turned_back(const model::State& state, int body, const model::Vec3& direction) {
  return body == model::no_body
             ? direction
             : model::Vec3(state.orientation[static_cast<std::size_t>(body)].to_eigen().conjugate() *
                           direction);
}

model::Vec3 place(const model::State& state, int body) {
  return body == model::no_body ? model::Vec3(model::Vec3::Zero())
                                : state.position[static_cast<std::size_t>(body)];
}

}  // namespace

std::vector<JointAxis> axes_of(const model::Model& model) {
  std::vector<JointAxis> axes;
  for (int joint = 0; joint < model.num_joints(); ++joint) {
    const int num_axes = model::traits_of(model.joints[static_cast<std::size_t>(joint)].kind).num_axes;
    for (int axis = 0; axis < num_axes; ++axis) axes.push_back({joint, axis});
  }
  return axes;
}

JointCoordinates::JointCoordinates(const model::Model& model) : axes_(axes_of(model)) {
  const model::State start = model::initial_state(model);
  for (const JointAxis& at : axes_) {
    const model::Joint& joint = model.joints[static_cast<std::size_t>(at.joint)];
    Seen seen;
    const bool is_first = at.axis == 0;
    seen.from = is_first ? joint.body_a : joint.body_b;
    seen.to = is_first ? joint.body_b : joint.body_a;
    seen.sign = is_first ? -1 : 1;
    seen.axis = is_first ? joint.axis1_a : joint.axis2_b;
    seen.slides = model::traits_of(joint.kind).slides;
    if (seen.slides) seen.start = length(seen, start);
    // Where a joint has two axes, one is seen to turn about the other.
    const model::Vec3 direction = axis_direction(start, joint, at.axis);
    const bool has_two = model::traits_of(joint.kind).num_axes == 2;
    model::Vec3 normal = has_two ? axis_direction(start, joint, 1 - at.axis) : direction.unitOrthogonal();
    normal = (normal - direction * direction.dot(normal)).normalized();
    seen.normal = turned_back(start, seen.from, normal);
    seen.mark = turned_back(start, seen.to, normal);
    seen_.push_back(seen);
  }
}

double JointCoordinates::angle(const Seen& seen, const model::State& state) {
  const model::Pose from = state.pose(seen.from), to = state.pose(seen.to);
  const model::Vec3 axis = from.direction_to_outer(seen.axis), normal = from.direction_to_outer(seen.normal);
  const model::Vec3 mark = to.direction_to_outer(seen.mark);
  return seen.sign * core::angle_of(axis.dot(normal.cross(mark)), normal.dot(mark));
}

double JointCoordinates::length(const Seen& seen, const model::State& state) {
  return state.pose(seen.from).direction_to_outer(seen.axis).dot(place(state, seen.from) -
                                                                 place(state, seen.to)) -
         seen.start;
}

void JointCoordinates::measure(const model::State& state, std::span<double> coordinates) const {
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

model::Vec3 axis_direction(const model::State& state, const model::Joint& joint, int axis) {
  return axis == 0 ? state.pose(joint.body_a).direction_to_outer(joint.axis1_a)
                   : state.pose(joint.body_b).direction_to_outer(joint.axis2_b);
}

}  // namespace pbmpi::analysis
