#include "solver/spaces/packed_state.h"

#include <algorithm>

#include "model/state_parts.h"

namespace pbmpi::solver {

PackedState::PackedState(const model::Model& model)
    : state_(model::initial_state(model)), poses_(model.bodies.size()), stale_(model.bodies.size(), 0) {}

void PackedState::start(const model::State& state, Pack& pack) {
  pack.load(0, state);
  state_ = state;
  pack.store(0, state_);
  for (int body = 0; body < state_.num_bodies(); ++body) place(body);
  std::fill(stale_.begin(), stale_.end(), 0);
}

void PackedState::place(int body) {
  poses_[body] = geometry::body_pose({state_.position[body], state_.orientation[body]});
}

void PackedState::take_in(std::span<const int> bodies) {
  for (const int body : bodies) {
    stale_[body] = 1;
    place(body);
  }
}

void PackedState::put_states(std::span<const int> bodies, std::span<const double> rows) {
  model::put_body_rows(rows, bodies, state_);
  take_in(bodies);
}

void PackedState::launch(const model::Event& event, Pack& pack) {
  const std::span<const int> body(&event.body, 1);
  pack.load(0, body, state_);
  pack.launch(0, event);
  pack.store(0, body, state_);
  stale_[event.body] = 0;
  place(event.body);
}

void PackedState::load_stale(std::span<const int> bodies, Pack& pack) {
  loaded_.clear();
  for (const int body : bodies) {
    if (!stale_[body]) continue;
    loaded_.push_back(body);
    stale_[body] = 0;
  }
  if (!loaded_.empty()) pack.load(0, loaded_, state_);
}

void PackedState::lend(std::span<const int> bodies, Pack& pack) {
  load_stale(bodies, pack);
  lent_.insert(lent_.end(), loaded_.begin(), loaded_.end());
}

void PackedState::activate(std::span<const int> bodies) {
  std::vector<char> others(stale_.size(), 1);
  for (const int body : bodies) others[body] = stale_[body];
  stale_ = std::move(others);
}

void PackedState::load(std::span<const int> bodies, Pack& pack) { load_stale(bodies, pack); }

void PackedState::store(std::span<const int> bodies, const Pack& pack, bool others_stay) {
  pack.store(0, bodies, state_);
  if (!others_stay) {
    for (const int body : lent_) stale_[body] = 1;
  }
  for (const int body : bodies) stale_[body] = 0;
  lent_.clear();
  for (const int body : bodies) place(body);
}

}  // namespace pbmpi::solver
