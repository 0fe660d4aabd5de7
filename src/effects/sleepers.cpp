#include "effects/sleepers.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace pbmpi::effects {
namespace {

void sort_unique(std::vector<int>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

std::int64_t step_of(const model::Event& event) { return event.step; }
std::int64_t step_of(std::int64_t step) { return step; }

void begin_rest(int body, model::State& state) {
  state.rest[body] = {state.position[body], state.orientation[body], 0};
}

}  // namespace

std::vector<BodyPair> touching_bodies(std::span<const model::Contact> contacts) {
  std::vector<BodyPair> pairs;
  pairs.reserve(contacts.size());
  for (const model::Contact& contact : contacts) pairs.emplace_back(contact.body_a, contact.body_b);
  return pairs;
}

Sleepers::Sleepers(const model::Model& model, double dt_s)
    : model_(&model),
      steps_(std::max(1, static_cast<int>(std::ceil(model.sleep.after_s / dt_s - 1e-9)))),
      distance_m_(model.sleep.speed * model.sleep.after_s),
      least_cosine_(core::cosine(std::min(model.sleep.angular_speed * model.sleep.after_s / 2, 1.5))),
      sets_(model.num_bodies()) {}

void Sleepers::start(model::State& state) {
  if (state.rest.empty()) {
    state.rest.resize(state.position.size());
    for (int body = 0; body < state.num_bodies(); ++body) begin_rest(body, state);
  }
  find_awake(state);
}

void Sleepers::find_awake(const model::State& state) {
  awake_.clear();
  for (int body = 0; body < state.num_bodies(); ++body) {
    if (!state.rest[body].asleep()) awake_.push_back(body);
  }
}

std::vector<int> Sleepers::islands_called(std::int64_t step, const model::State& state) const {
  std::vector<int> islands;
  const auto call = [&](int body) {
    if (body != model::no_body && state.rest[body].asleep()) islands.push_back(state.rest[body].island());
  };
  const auto by_step = [](const auto& a, const auto& b) { return step_of(a) < step_of(b); };
  const auto first = std::lower_bound(model_->events.begin(), model_->events.end(), step, by_step);
  const auto last = std::upper_bound(first, model_->events.end(), step + 1, by_step);
  for (auto event = first; event != last; ++event) {
    // A joint that is released in a step breaks at the end of the previous step.
    const bool is_release = event->kind == model::EventKind::release;
    if (event->step != (is_release ? step + 1 : step)) continue;
    if (event->kind == model::EventKind::launch) {
      call(event->body);
    } else {
      call(model_->joints[event->joint].body_a);
      call(model_->joints[event->joint].body_b);
    }
  }
  sort_unique(islands);
  return islands;
}

std::vector<int> Sleepers::islands_touched(std::span<const BodyPair> touching, const model::State& state) {
  std::vector<int> islands;
  for (const auto& [a, b] : touching) {
    if (a == model::no_body || b == model::no_body || state.rest[a].asleep() == state.rest[b].asleep())
      continue;
    islands.push_back(state.rest[state.rest[a].asleep() ? a : b].island());
  }
  sort_unique(islands);
  return islands;
}

std::vector<int> Sleepers::islands_moved(const model::State& before, const model::State& after) {
  std::vector<int> islands;
  for (std::size_t body = 0; body < before.rest.size(); ++body) {
    const bool is_as_before = after.position[body] == before.position[body] &&
                              after.orientation[body] == before.orientation[body] &&
                              after.velocity[body] == before.velocity[body] &&
                              after.angular_velocity[body] == before.angular_velocity[body];
    if (before.rest[body].asleep() && !is_as_before) islands.push_back(before.rest[body].island());
  }
  sort_unique(islands);
  return islands;
}

void Sleepers::wake_in(model::State& state, std::span<const int> islands) {
  for (int body = 0; body < static_cast<int>(state.rest.size()); ++body) {
    const model::Rest& rest = state.rest[body];
    if (rest.asleep() && std::binary_search(islands.begin(), islands.end(), rest.island()))
      begin_rest(body, state);
  }
}

bool Sleepers::wake(std::span<const int> islands, model::State& state) {
  if (islands.empty()) return false;
  wake_in(state, islands);
  find_awake(state);
  return true;
}

bool Sleepers::stays(const model::Rest& rest, const model::State& state, int body) const {
  const core::Quat &q = state.orientation[body], &p = rest.orientation;
  const double cosine = std::abs(q.w * p.w + q.x * p.x + q.y * p.y + q.z * p.z);  // of half the angle
  return (state.position[body] - rest.position).squaredNorm() <= distance_m_ * distance_m_ &&
         cosine >= least_cosine_;
}

void Sleepers::count(std::span<const int> bodies, model::State& state) const {
  for (const int body : bodies) {
    model::Rest& rest = state.rest[body];
    if (!stays(rest, state, body)) {
      begin_rest(body, state);
    } else if (rest.idle_steps < steps_) {
      ++rest.idle_steps;
    }
  }
}

std::vector<Resting> Sleepers::find_resting(std::span<const int> bodies, std::span<const BodyPair> touching,
                                            const model::State& state) {
  std::vector<Resting> resting;
  const auto rests = [&](int body) { return state.rest[body].idle_steps >= steps_; };
  if (std::none_of(bodies.begin(), bodies.end(), rests)) return resting;
  sets_.reset(state.num_bodies());
  const auto unite = [&](int a, int b) {
    if (a != model::no_body && b != model::no_body) sets_.unite(a, b);
  };
  for (std::size_t joint = 0; joint < model_->joints.size(); ++joint) {
    if (!state.is_broken(joint)) unite(model_->joints[joint].body_a, model_->joints[joint].body_b);
  }
  for (const auto& [a, b] : touching) unite(a, b);
  restless_.assign(state.position.size(), 0);
  for (const int body : bodies) {
    if (!rests(body)) restless_[sets_.find(body)] = 1;
  }
  for (const int body : bodies) {
    const int island = sets_.find(body);
    if (restless_[island] == 0) resting.push_back({body, island});
  }
  return resting;
}

std::vector<Resting> Sleepers::join(int num_bodies, std::span<const Resting> resting,
                                    std::span<const BodyPair> touching) {
  model::DisjointSets sets(num_bodies);
  std::vector<char> rests(static_cast<std::size_t>(num_bodies), 0), restless(rests.size(), 0);
  for (const Resting& one : resting) {
    sets.unite(one.body, one.island);
    rests[one.body] = 1;
  }
  for (const auto& [a, b] : touching) sets.unite(a, b);
  for (const auto& [a, b] : touching) {
    for (const int body : {a, b}) restless[sets.find(body)] |= rests[body] == 0;
  }
  std::vector<Resting> joined;
  for (int body = 0; body < num_bodies; ++body) {
    const int island = sets.find(body);
    if (rests[body] && !restless[island]) joined.push_back({body, island});
  }
  return joined;
}

void Sleepers::put_to_sleep(std::span<const Resting> resting, model::State& state) {
  if (resting.empty()) return;
  for (const Resting& one : resting) {
    state.rest[one.body].sleep_in(one.island);
    state.velocity[one.body].setZero();
    state.angular_velocity[one.body].setZero();
  }
  find_awake(state);
}

}  // namespace pbmpi::effects
