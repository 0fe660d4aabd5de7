#include "model/state.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/hash.h"
#include "model/state_parts.h"

namespace pbmpi::model {
namespace {

/// Adds all bits of a memory to a hash. A joint without force counts as none, so that having no joint entries
/// and having an entry of zeros for each joint give the same hash.
void add_bits(const StepMemory& memory, core::Hash64& hash) {
  std::vector<double> contact_rows;
  append_rows(memory.contacts, contact_rows);
  hash.add(contact_rows.data(), contact_rows.size());
  std::array<double, row_width<JointForce>> row;
  const auto is_zero = [](double number) { return std::bit_cast<std::uint64_t>(number) == 0; };
  for (std::size_t joint = 0; joint < memory.joints.size(); ++joint) {
    put_row(memory.joints[joint], row.data());
    if (std::ranges::all_of(row, is_zero)) continue;
    hash.add(static_cast<std::uint64_t>(joint));
    hash.add(row.data(), row.size());
  }
}

}  // namespace

void State::resize(int num_bodies) {
  for (const BodyColumn& column : body_columns) {
    std::visit([&](auto array) { (this->*array).resize(static_cast<std::size_t>(num_bodies)); },
               column.member);
  }
}

void copy_body(int body, const State& from, State& to) {
  for (const BodyColumn& column : body_columns)
    std::ranges::copy(column.of(from, body), column.of(to, body).begin());
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
  for (int body = 0; body < state.num_bodies(); ++body) {
    for (const BodyColumn& column : body_columns) hash.add(column.of(state, body).data(), column.width());
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
  const auto is_finite = [&](int body) {
    return std::ranges::all_of(body_columns, [&](const BodyColumn& column) {
      return std::ranges::all_of(column.of(state, body), [](double number) { return std::isfinite(number); });
    });
  };
  int count = 0;
  for (int body = 0; body < state.num_bodies(); ++body) count += is_finite(body) ? 0 : 1;
  return count;
}

void forget(const Model& model, int body, StepMemory& memory) {
  std::erase_if(memory.contacts, [body](const ContactForce& contact) {
    return contact.body_a == body || contact.body_b == body;
  });
  for (std::size_t joint = 0; joint < memory.joints.size(); ++joint) {
    const Joint& one = model.joints[joint];
    if (one.body_a == body || one.body_b == body) memory.joints[joint] = {};
  }
}

}  // namespace pbmpi::model
