#include "model/state.h"

#include <cmath>

#include "core/hash.h"
#include "model/memory_rows.h"

namespace pbmpi::model {

void State::resize(int num_bodies) {
  const auto n = static_cast<std::size_t>(num_bodies);
  position.resize(n);
  orientation.resize(n);
  velocity.resize(n);
  angular_velocity.resize(n);
}

void copy_body(int body, const State& from, State& to) {
  const auto at = static_cast<std::size_t>(body);
  to.position[at] = from.position[at];
  to.orientation[at] = from.orientation[at];
  to.velocity[at] = from.velocity[at];
  to.angular_velocity[at] = from.angular_velocity[at];
}

Rest begin_rest(const State& state, int body) {
  const Pose pose = state.pose(body);
  return {.position = pose.position,
          .orientation = pose.orientation,
          .velocity = state.velocity[body],
          .angular_velocity = state.angular_velocity[body],
          .watches = {{{.knots = {pose, pose}}, {.knots = {pose, pose}}}}};
}

State initial_state(const Model& model) {
  State state;
  state.resize(model.num_bodies());
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Body& body = model.bodies[i];
    state.position[i] = body.pose.position;
    state.orientation[i] = body.pose.orientation;
    state.velocity[i] = body.velocity;
    state.angular_velocity[i] = body.angular_velocity;
  }
  return state;
}

std::uint64_t hash(const State& state) {
  core::Hash64 hash;
  for (std::size_t i = 0; i < state.position.size(); ++i) {
    hash.add(state.position[i].data(), 3);
    hash.add(&state.orientation[i].w, 4);
    hash.add(state.velocity[i].data(), 3);
    hash.add(state.angular_velocity[i].data(), 3);
  }
  for (std::size_t joint = 0; joint < state.broken_in.size(); ++joint) {
    if (!state.is_broken(joint)) continue;
    hash.add(static_cast<std::uint64_t>(joint));
    hash.add(static_cast<std::uint64_t>(state.broken_in[joint]));
  }
  add_bits(state.memory, hash);
  if (state.guard.frozen_in >= 0) hash.add(static_cast<std::uint64_t>(state.guard.frozen_in));
  return hash.value();
}

int count_nonfinite(const State& state) {
  int count = 0;
  for (std::size_t i = 0; i < state.position.size(); ++i) {
    const Quat& q = state.orientation[i];
    const bool finite = state.position[i].allFinite() && state.velocity[i].allFinite() &&
                        state.angular_velocity[i].allFinite() && std::isfinite(q.w) && std::isfinite(q.x) &&
                        std::isfinite(q.y) && std::isfinite(q.z);
    count += finite ? 0 : 1;
  }
  return count;
}

}  // namespace pbmpi::model
