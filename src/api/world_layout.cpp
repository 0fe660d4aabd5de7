#include "api/world_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "core/error.h"
#include "core/text.h"
#include "model/joint_traits.h"
#include "model/state_parts.h"

namespace pbmpi::api {
namespace {

/// The array of each of model::body_columns.
constexpr std::array<std::vector<double> BatchState::*, model::body_columns.size()> members = {
    &BatchState::position, &BatchState::orientation, &BatchState::velocity, &BatchState::angular_velocity};
/// A caller may have normalised in single precision, or rounded otherwise.
constexpr double length_tolerance = 1e-3;

/// Throws unless the numbers of body `body` in world `id` are finite.
void require_finite(std::span<const double> numbers, const char* name, int id, const std::string& body) {
  core::require_input(std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }),
                      std::string(name) + " of body " + core::in_quotes(body) + " in world " +
                          std::to_string(id) + " is not finite; set finite numbers, or reset the world");
}

void require_turn(const model::Quat& q, int id, const std::string& body) {
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  core::require_input(std::abs(length - 1) <= length_tolerance,
                      "orientation of body " + core::in_quotes(body) + " in world " + std::to_string(id) +
                          " has the length " + std::to_string(length) +
                          "; a rotation is a quaternion (w, x, y, z) of length 1");
}

/// Does the axis have a motor, at the start or by an event?
bool has_motor(const model::Model& model, int joint, int axis) {
  const model::Joint& held = model.joints[static_cast<std::size_t>(joint)];
  return held.motors[static_cast<std::size_t>(axis)].active() ||
         std::any_of(model.events.begin(), model.events.end(), [&](const model::Event& event) {
           return event.kind == model::EventKind::motor && event.joint == joint && event.axis == axis &&
                  event.motor.active();
         });
}

/// Throws unless `theirs`, the names of world `world`, are `ours`, the first world's. `what`: "bodies".
void require_names(int world, const std::vector<std::string>& theirs, const std::vector<std::string>& ours,
                   const std::string& what) {
  const std::string begin = "world " + std::to_string(world) + " has other " + what + " than world 0: ";
  const std::string end = "; all worlds of a batch have the same, make a batch for each kind of world";
  for (std::size_t i = 0; i < std::min(theirs.size(), ours.size()); ++i) {
    core::require_input(theirs[i] == ours[i], begin + core::in_quotes(theirs[i]) + " in the place of " +
                                                  core::in_quotes(ours[i]) + end);
  }
  core::require_input(theirs.size() == ours.size(), begin + std::to_string(theirs.size()) + " and not " +
                                                        std::to_string(ours.size()) + end);
}

template <class Axis>
std::vector<std::string> names_of(const std::vector<Axis>& axes) {
  std::vector<std::string> names;
  names.reserve(axes.size());
  for (const Axis& axis : axes) names.push_back(axis.name);
  return names;
}

std::string name_of(const model::Joint& joint, int axis) { return joint.name + (axis == 0 ? "" : "/2"); }

}  // namespace

BatchState make_arrays(int num_worlds, int num_bodies) {
  const std::size_t bodies = static_cast<std::size_t>(num_worlds) * static_cast<std::size_t>(num_bodies);
  BatchState arrays;
  for (std::size_t i = 0; i < members.size(); ++i)
    (arrays.*members[i]).resize(model::body_columns[i].width() * bodies);
  return arrays;
}

void require_shape(const BatchState& arrays, int num_worlds, int num_bodies) {
  const BatchState wanted = make_arrays(num_worlds, num_bodies);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::size_t length = (arrays.*members[i]).size(), fit = (wanted.*members[i]).size();
    const model::BodyColumn& column = model::body_columns[i];
    core::require_input(length == fit, std::string(column.name) + " has " + std::to_string(length) +
                                           " numbers, and [" + std::to_string(num_worlds) + "][" +
                                           std::to_string(num_bodies) + "][" +
                                           std::to_string(column.width()) + "] are " + std::to_string(fit));
  }
}

void put(const model::State& state, int index, BatchState& arrays) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::span<const double> numbers = model::body_columns[i].of(state);
    std::ranges::copy(numbers, (arrays.*members[i]).begin() + index * std::ssize(numbers));
  }
}

void take(const BatchState& arrays, int index, int id, const model::Model& model, model::State& state) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    const model::BodyColumn& column = model::body_columns[i];
    const std::span<double> numbers = column.of(state);
    std::copy_n((arrays.*members[i]).begin() + index * std::ssize(numbers), numbers.size(), numbers.begin());
    for (int body = 0; body < state.num_bodies(); ++body)
      require_finite(column.of(state, body), column.name, id, model.bodies[body].name);
  }
  for (int body = 0; body < state.num_bodies(); ++body)
    require_turn(state.orientation[body], id, model.bodies[body].name);
}

WorldLayout::WorldLayout(const model::Model& model) {
  for (const model::Body& body : model.bodies) body_names_.push_back(body.name);
  for (int joint = 0; joint < model.num_joints(); ++joint) {
    const model::Joint& held = model.joints[static_cast<std::size_t>(joint)];
    for (const int axis : {0, 1}) {
      if (!has_motor(model, joint, axis)) continue;
      const model::AxisMotor& motor = held.motors[static_cast<std::size_t>(axis)];
      motors_.push_back({name_of(held, axis), motor.max_force, motor.hold_rate});
      axes_.push_back({joint, axis});
    }
  }
  for (const analysis::JointAxis& at : analysis::axes_of(model)) {
    const model::Joint& joint = model.joints[static_cast<std::size_t>(at.joint)];
    joint_axes_.push_back({name_of(joint, at.axis), model::traits_of(joint.kind).slides});
  }
}

void WorldLayout::require_same(int world, const model::Model& model) const {
  const WorldLayout other(model);
  require_names(world, other.body_names_, body_names_, "bodies");
  require_names(world, names_of(other.motors_), names_of(motors_), "motors");
  require_names(world, names_of(other.joint_axes_), names_of(joint_axes_), "joints");
  core::require_input(other.axes_ == axes_, "world " + std::to_string(world) +
                                                " has its motors on other joints than world 0; make a batch "
                                                "for each kind of world");
}

}  // namespace pbmpi::api
