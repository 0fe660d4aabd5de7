#include "mpi/worlds/owned_worlds.h"

#include <utility>

#include "mpi/comm/agreement.h"
#include "mpi/frame/state_transfer.h"
#include "mpi/frame/whole_state.h"

namespace pbmpi::mpi {

OwnedWorlds::OwnedWorlds(const Communicator& comm, stepping::WorldStepper& stepper, BuildWorld build,
                         Placement placement, const Start& start)
    : comm_(&comm),
      stepper_(&stepper),
      build_(std::move(build)),
      placement_(std::move(placement)),
      first_world_(start.first_world) {
  find_own();
  std::map<int, model::State> states;
  if (start.step > 0) states = scatter_states(comm, placement_, start.states);
  agree_on_errors(comm, [&] {
    for (const int world : ids_) {
      const std::shared_ptr<const model::Model> model = build_(world);
      if (start.step == 0) states[world] = model::initial_state(*model);
      require_fit(world, states[world], *model);
      stepper.add(number_of(world), model, states[world], start.step);
      states.erase(world);
    }
  });
  count_bodies();
}

std::vector<model::State> OwnedWorlds::gather_states() const {
  return mpi::gather_states(*comm_, placement_, [this](int world) -> const model::State& {
    return stepper_->state(number_of(world));
  });
}

void OwnedWorlds::find_own() {
  ids_.clear();
  for (std::size_t world = 0; world < placement_.size(); ++world) {
    if (placement_[world] == comm_->rank()) ids_.push_back(static_cast<int>(world));
  }
}

void OwnedWorlds::count_bodies() {
  std::vector<std::int64_t> num_bodies(placement_.size(), 0);
  for (const int world : ids_) num_bodies[world] = stepper_->model(number_of(world)).num_bodies();
  comm_->allreduce(num_bodies, Reduce::max);
  for (const std::int64_t count : num_bodies) table_.body_offset.push_back(table_.body_offset.back() + count);
}

std::vector<stepping::LocalWorld> OwnedWorlds::views() const {
  std::vector<stepping::LocalWorld> worlds;
  worlds.reserve(ids_.size());
  for (const int world : ids_) {
    const int number = number_of(world);
    worlds.push_back({world, &stepper_->model(number), &stepper_->state(number),
                      &stepper_->observables(number), stepper_->profile(number), stepper_->contacts(number)});
  }
  return worlds;
}

void OwnedWorlds::move(std::span<const Move> moves, std::int64_t step) {
  // Every rank goes through the moves in the same order, so that blocking calls cannot deadlock.
  std::vector<std::pair<int, model::State>> arrivals;
  for (const Move& move : moves) {
    if (placement_[move.part] == comm_->rank()) {
      send_state(*comm_, stepper_->state(number_of(move.part)), move.to);
    } else if (move.to == comm_->rank()) {
      arrivals.emplace_back(move.part, receive_state(*comm_, placement_[move.part]));
    }
  }
  agree_on_errors(*comm_, [&] {
    for (const Move& move : moves) {
      if (placement_[move.part] == comm_->rank()) stepper_->remove(number_of(move.part));
    }
    for (const auto& [world, state] : arrivals) {
      std::shared_ptr<const model::Model> model = build_(world);
      require_rows(world, state, *model);
      stepper_->add(number_of(world), std::move(model), state, step);
    }
  });
  for (const Move& move : moves) placement_[move.part] = move.to;
  find_own();
}

}  // namespace pbmpi::mpi
