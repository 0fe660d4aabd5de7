#include "mpi/owned_worlds.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "core/error.h"
#include "mpi/agreement.h"

namespace pbmpi::mpi {
namespace {

constexpr int state_tag = 1;

/// Of a state as it travels; State::broken_in, with the effect "breakable_joints", as a number a joint.
std::size_t num_doubles(const model::State& state) {
  return model::numbers_of_state * state.position.size() + model::numbers_of_rest * state.rest.size() +
         state.broken_in.size();
}

/// Bit for bit: what a NaN carries survives, too.
std::vector<double> pack(const model::State& state) {
  const std::size_t n = state.position.size();
  std::vector<double> packed(num_doubles(state));
  if (n == 0) return packed;
  std::memcpy(packed.data(), state.position.front().data(), 3 * n * sizeof(double));
  std::memcpy(packed.data() + 3 * n, &state.orientation.front().w, 4 * n * sizeof(double));
  std::memcpy(packed.data() + 7 * n, state.velocity.front().data(), 3 * n * sizeof(double));
  std::memcpy(packed.data() + 10 * n, state.angular_velocity.front().data(), 3 * n * sizeof(double));
  double* row = packed.data() + model::numbers_of_state * n;
  for (const model::Rest& rest : state.rest) {
    std::memcpy(row, rest.position.data(), 3 * sizeof(double));
    std::memcpy(row + 3, &rest.orientation.w, 4 * sizeof(double));
    row[7] = rest.idle_steps;
    row += model::numbers_of_rest;
  }
  std::copy(state.broken_in.begin(), state.broken_in.end(), row);
  return packed;
}

/// `num_joints`: of State::broken_in.
model::State unpack(const std::vector<double>& packed, std::size_t n, std::size_t num_joints) {
  model::State state;
  state.resize(static_cast<int>(n));
  if (n == 0) return state;
  std::memcpy(state.position.front().data(), packed.data(), 3 * n * sizeof(double));
  std::memcpy(&state.orientation.front().w, packed.data() + 3 * n, 4 * n * sizeof(double));
  std::memcpy(state.velocity.front().data(), packed.data() + 7 * n, 3 * n * sizeof(double));
  std::memcpy(state.angular_velocity.front().data(), packed.data() + 10 * n, 3 * n * sizeof(double));
  if (packed.size() > model::numbers_of_state * n + num_joints) state.rest.resize(n);
  const double* row = packed.data() + model::numbers_of_state * n;
  for (model::Rest& rest : state.rest) {
    std::memcpy(rest.position.data(), row, 3 * sizeof(double));
    std::memcpy(&rest.orientation.w, row + 3, 4 * sizeof(double));
    rest.idle_steps = static_cast<std::int32_t>(row[7]);
    row += model::numbers_of_rest;
  }
  for (std::size_t joint = 0; joint < num_joints; ++joint)
    state.broken_in.push_back(static_cast<std::int32_t>(row[joint]));
  return state;
}

}  // namespace

OwnedWorlds::OwnedWorlds(const Communicator& comm, model::WorldStepper& stepper, BuildWorld build,
                         Placement placement)
    : comm_(&comm), stepper_(&stepper), build_(std::move(build)), placement_(std::move(placement)) {
  find_own();
  agree_on_errors(comm, [&] {
    for (const int world : ids_) {
      const std::shared_ptr<const model::Model> model = build_(world);
      stepper.add(world, model, model::initial_state(*model), 0);
    }
  });
  exchange_sizes();
}

void OwnedWorlds::find_own() {
  ids_.clear();
  for (std::size_t world = 0; world < placement_.size(); ++world) {
    if (placement_[world] == comm_->rank()) ids_.push_back(static_cast<int>(world));
  }
}

void OwnedWorlds::exchange_sizes() {
  std::vector<std::int64_t> num_bodies(placement_.size(), 0);
  state_doubles_.assign(placement_.size(), 0);
  state_joints_.assign(placement_.size(), 0);
  for (const int world : ids_) {
    num_bodies[world] = stepper_->model(world).num_bodies();
    state_doubles_[world] = static_cast<std::int64_t>(num_doubles(stepper_->state(world)));
    state_joints_[world] = std::ssize(stepper_->state(world).broken_in);
  }
  comm_->allreduce(num_bodies, Reduce::max);
  comm_->allreduce(state_doubles_, Reduce::max);
  comm_->allreduce(state_joints_, Reduce::max);
  for (const std::int64_t count : num_bodies) table_.body_offset.push_back(table_.body_offset.back() + count);
}

std::vector<model::LocalWorld> OwnedWorlds::views() const {
  std::vector<model::LocalWorld> worlds;
  worlds.reserve(ids_.size());
  for (const int world : ids_) {
    worlds.push_back({world, &stepper_->model(world), &stepper_->state(world), &stepper_->observables(world),
                      stepper_->profile(world)});
  }
  return worlds;
}

void OwnedWorlds::move(std::span<const Move> moves, std::int64_t step) {
  // Every rank goes through the moves in the same order, so that blocking calls cannot wait in a circle.
  std::vector<std::pair<int, model::State>> arrivals;
  for (const Move& move : moves) {
    if (placement_[move.world] == comm_->rank()) {
      comm_->send(std::span<const double>(pack(stepper_->state(move.world))), move.to, state_tag);
    } else if (move.to == comm_->rank()) {
      const std::int64_t num_bodies = table_.body_offset[move.world + 1] - table_.body_offset[move.world];
      std::vector<double> packed(state_doubles_[move.world]);
      comm_->recv(std::span(packed), placement_[move.world], state_tag);
      arrivals.emplace_back(move.world, unpack(packed, num_bodies, state_joints_[move.world]));
    }
  }
  agree_on_errors(*comm_, [&] {
    for (const Move& move : moves) {
      if (placement_[move.world] == comm_->rank()) stepper_->remove(move.world);
    }
    for (const auto& [world, state] : arrivals) {
      std::shared_ptr<const model::Model> model = build_(world);
      if (model->num_bodies() != state.num_bodies()) {
        throw core::RunError("world " + std::to_string(world) + " was built with " +
                             std::to_string(model->num_bodies()) + " bodies where it had " +
                             std::to_string(state.num_bodies()) + " on its last rank");
      }
      stepper_->add(world, std::move(model), state, step);
    }
  });
  for (const Move& move : moves) placement_[move.world] = move.to;
  find_own();
}

}  // namespace pbmpi::mpi
