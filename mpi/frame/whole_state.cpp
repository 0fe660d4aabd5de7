#include "mpi/frame/whole_state.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "core/error.h"

namespace pbmpi::mpi {
namespace {

constexpr std::size_t num_lengths = 3;  ///< bodies, rows of State::rest, joints
constexpr std::size_t numbers_of_guard = 3;

std::size_t size_of(std::size_t bodies, std::size_t rests, std::size_t joints) {
  return num_lengths + model::numbers_of_state * bodies + model::numbers_of_rest * rests + joints +
         numbers_of_guard;
}

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

}  // namespace

std::int64_t packed_size(const model::State& state) {
  return static_cast<std::int64_t>(size_of(state.position.size(), state.rest.size(), state.broken_in.size()));
}

std::vector<double> pack(const model::State& state) {
  std::vector<double> packed(static_cast<std::size_t>(packed_size(state)));
  double* to = packed.data();
  *to++ = static_cast<double>(state.position.size());
  *to++ = static_cast<double>(state.rest.size());
  *to++ = static_cast<double>(state.broken_in.size());
  to = put(state.position, to);
  to = put(state.orientation, to);
  to = put(state.velocity, to);
  to = put(state.angular_velocity, to);
  for (const model::Rest& rest : state.rest) {
    std::memcpy(to, rest.position.data(), 3 * sizeof(double));
    std::memcpy(to + 3, &rest.orientation.w, 4 * sizeof(double));
    to[7] = rest.idle_steps;
    to += model::numbers_of_rest;
  }
  to = std::copy(state.broken_in.begin(), state.broken_in.end(), to);
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
  refuse_unless(packed.size() >= num_lengths);
  const auto bodies = static_cast<std::size_t>(packed[0]);
  const auto joints = static_cast<std::size_t>(packed[2]);
  state.rest.resize(static_cast<std::size_t>(packed[1]));
  refuse_unless(packed.size() == size_of(bodies, state.rest.size(), joints));
  state.resize(static_cast<int>(bodies));
  const double* from = packed.data() + num_lengths;
  from = take(from, state.position);
  from = take(from, state.orientation);
  from = take(from, state.velocity);
  from = take(from, state.angular_velocity);
  for (model::Rest& rest : state.rest) {
    std::memcpy(rest.position.data(), from, 3 * sizeof(double));
    std::memcpy(&rest.orientation.w, from + 3, 4 * sizeof(double));
    rest.idle_steps = static_cast<std::int32_t>(from[7]);
    from += model::numbers_of_rest;
  }
  for (std::size_t joint = 0; joint < joints; ++joint)
    state.broken_in.push_back(static_cast<std::int32_t>(from[joint]));
  from += joints;
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
  if (state.broken_in.empty() || state.broken_in.size() == model.joints.size()) return;
  throw core::RunError("world " + std::to_string(world) + " was built with " +
                       std::to_string(model.joints.size()) + " joints where it had " +
                       std::to_string(state.broken_in.size()) +
                       " before; a scene must build the same world each time");
}

}  // namespace pbmpi::mpi
