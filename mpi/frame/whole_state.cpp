#include "mpi/frame/whole_state.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include "core/error.h"
#include "model/memory_rows.h"

namespace pbmpi::mpi {
namespace {

constexpr std::size_t numbers_of_guard = 3;

/// Numbers of rows of a state, with which its packed form begins.
struct Lengths {
  std::size_t bodies = 0, rests = 0, joints = 0, contact_forces = 0, joint_forces = 0;

  static Lengths of(const model::State& state) {
    return {state.position.size(), state.rest.size(), state.broken_in.size(), state.memory.contacts.size(),
            state.memory.joints.size()};
  }
  /// In the order in which they are packed.
  static constexpr std::array<std::size_t Lengths::*, 5> all = {
      &Lengths::bodies, &Lengths::rests, &Lengths::joints, &Lengths::contact_forces, &Lengths::joint_forces};

  /// Length of the packed state in numbers.
  std::size_t packed() const {
    return all.size() + model::numbers_of_state * bodies + model::numbers_of_rest * rests + joints +
           model::numbers_of_contact_force * contact_forces + model::numbers_of_joint_force * joint_forces +
           numbers_of_guard;
  }
};

template <class Row>
double* put(const std::vector<Row>& rows, double* to) {
  if (rows.empty()) return to;
  std::memcpy(to, static_cast<const void*>(rows.data()), rows.size() * sizeof(Row));
  return to + rows.size() * sizeof(Row) / sizeof(double);
}

template <class Row>
const double* take(const double* from, std::vector<Row>& rows) {
  if (rows.empty()) return from;
  std::memcpy(static_cast<void*>(rows.data()), from, rows.size() * sizeof(Row));
  return from + rows.size() * sizeof(Row) / sizeof(double);
}

/// Throws unless there is one entry for each joint of the model, or none at all.
void require_joints(int world, std::size_t num_joints, const model::Model& model) {
  if (num_joints == 0 || num_joints == model.joints.size()) return;
  throw core::RunError("world " + std::to_string(world) + " was built with " +
                       std::to_string(model.joints.size()) + " joints where it had " +
                       std::to_string(num_joints) + " before; a scene must build the same world each time");
}

/// Does the model have the geoms and bodies of a contact?
bool acts_in(const model::ContactForce& force, const model::Model& model) {
  const auto is_within = [](int index, int lowest, std::ptrdiff_t end) {
    return index >= lowest && index < end;
  };
  const std::ptrdiff_t num_geoms = std::ssize(model.geoms), num_bodies = std::ssize(model.bodies);
  return is_within(force.geoms.first, 0, num_geoms) && is_within(force.geoms.second, 0, num_geoms) &&
         is_within(force.body_a, 0, num_bodies) && is_within(force.body_b, model::no_body, num_bodies);
}

}  // namespace

std::int64_t packed_size(const model::State& state) {
  return static_cast<std::int64_t>(Lengths::of(state).packed());
}

std::vector<double> pack(const model::State& state) {
  std::vector<double> packed(static_cast<std::size_t>(packed_size(state)));
  double* to = packed.data();
  const Lengths lengths = Lengths::of(state);
  for (const auto length : Lengths::all) *to++ = static_cast<double>(lengths.*length);
  to = put(state.position, to);
  to = put(state.orientation, to);
  to = put(state.velocity, to);
  to = put(state.angular_velocity, to);
  for (const model::Rest& rest : state.rest) to = model::put_row(rest, to);
  to = std::copy(state.broken_in.begin(), state.broken_in.end(), to);
  for (const model::ContactForce& force : state.memory.contacts) to = model::put_row(force, to);
  for (const model::JointForce& force : state.memory.joints) to = model::put_row(force, to);
  *to++ = state.guard.energy_gain_j;
  *to++ = state.guard.largest_kinetic_j;
  *to = state.guard.frozen_in;
  return packed;
}

model::State unpack(std::span<const double> packed) {
  model::State state;
  const auto refuse_unless = [&](bool fits) {
    if (fits) return;
    throw core::RunError("a packed state of " + std::to_string(packed.size()) +
                         " numbers has not the length that it begins with; run the same build on all ranks");
  };
  refuse_unless(packed.size() >= Lengths::all.size());
  const double* from = packed.data();
  Lengths lengths;
  for (const auto length : Lengths::all) {
    refuse_unless(*from >= 0 && *from <= static_cast<double>(packed.size()));
    lengths.*length = static_cast<std::size_t>(*from++);
  }
  refuse_unless(packed.size() == lengths.packed());
  state.resize(static_cast<int>(lengths.bodies));
  state.rest.resize(lengths.rests);
  state.memory.contacts.resize(lengths.contact_forces);
  state.memory.joints.resize(lengths.joint_forces);
  from = take(from, state.position);
  from = take(from, state.orientation);
  from = take(from, state.velocity);
  from = take(from, state.angular_velocity);
  for (model::Rest& rest : state.rest) from = model::take_row(from, rest);
  for (std::size_t joint = 0; joint < lengths.joints; ++joint)
    state.broken_in.push_back(static_cast<std::int32_t>(*from++));
  for (model::ContactForce& force : state.memory.contacts) from = model::take_row(from, force);
  for (model::JointForce& force : state.memory.joints) from = model::take_row(from, force);
  state.guard = {from[0], from[1], static_cast<std::int32_t>(from[2])};
  return state;
}

void require_rows(int world, const model::State& state, const model::Model& model) {
  if (state.num_bodies() == model.num_bodies() &&
      (state.rest.empty() || std::ssize(state.rest) == model.num_bodies())) {
    return;
  }
  throw core::RunError("world " + std::to_string(world) + " was built with " +
                       std::to_string(model.num_bodies()) + " bodies where it had " +
                       std::to_string(state.num_bodies()) +
                       " before; a scene must build the same world each time");
}

void require_fit(int world, const model::State& state, const model::Model& model) {
  require_rows(world, state, model);
  require_joints(world, state.broken_in.size(), model);
  require_joints(world, state.memory.joints.size(), model);
  const auto fits = [&](const model::ContactForce& force) { return acts_in(force, model); };
  if (std::all_of(state.memory.contacts.begin(), state.memory.contacts.end(), fits)) return;
  throw core::RunError("world " + std::to_string(world) +
                       " was built without a body or geom on which a contact force of its state acts; "
                       "a scene must build the same world each time");
}

}  // namespace pbmpi::mpi
