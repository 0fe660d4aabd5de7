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

/// Share of the rule's speeds up to which a steady motion counts as a solver's creep: 0.1 mm/s by default, a
/// third of what stacks and humans at rest drift with `sor`; a body of 1 mm/s is seen to move.
constexpr double creep = 1.0 / 500;
/// In how many of the rule's times an acceleration that counts as none makes a creep: 1e-5 m/s^2 by default.
constexpr double creep_builds_up = 20;
/// By how many standard deviations of its trembling a motion stands out.
constexpr double deviations = 3;
/// The long watch: how many intervals of the short one make up one of its own.
constexpr int long_interval = 8;
/// Share of the rule's speeds by which a body at rest may at most sway on the long watch: 1 cm/s, the hands
/// of a standing human, which hang like pendulums of 1 s and swing by 3 mm.
constexpr double sway = 1.0 / 5;

/// Ways [m] or turns [rad] in two intervals one after the other.
struct Course {
  core::Vec3 first, second;
};

/// The small rotation from `from` to `to` [rad], world frame.
core::Vec3 turn(const core::Quat& from, const core::Quat& to) {
  const core::Vec3 p(from.x, from.y, from.z), q(to.x, to.y, to.z);
  const core::Vec3 half = from.w * q - to.w * p - q.cross(p);
  return (from.w * to.w + p.dot(q) < 0 ? -2 : 2) * half;
}

Course way(const model::MotionWatch& watch, const core::Pose& now) {
  return {watch.knots[1].position - watch.knots[0].position, now.position - watch.knots[1].position};
}
Course turns(const model::MotionWatch& watch, const core::Pose& now) {
  return {turn(watch.knots[0].orientation, watch.knots[1].orientation),
          turn(watch.knots[1].orientation, now.orientation)};
}

/// Does a motion through two intervals of `steps` steps of `step_s` stand out? Of a velocity whose values in
/// steps are independent, and which changes from each to the next by `tremble` (a mean square), the mean over
/// n steps has the variance tremble / (2 n).
bool stands_out(const Course& course, double tremble, int steps, double step_s, double creep_m_s,
                double creep_m_s2) {
  const double interval_s = steps * step_s, deviation = deviations * std::sqrt(tremble / 2);
  const double speed = (course.first + course.second).norm() / (2 * interval_s);
  const double gain = (course.second - course.first).norm() / interval_s;
  return speed > creep_m_s + deviation / std::sqrt(2.0 * steps) ||
         gain > creep_m_s2 * interval_s + deviation * std::sqrt(2.0 / steps);
}

/// Takes a step into the mean squares over the last two intervals, older ones fading.
void add_changes(const core::Vec3& change, const core::Vec3& angular_change, int interval,
                 model::MotionWatch& watch) {
  watch.tremble += (change.squaredNorm() - watch.tremble) / (2 * interval);
  watch.angular_tremble += (angular_change.squaredNorm() - watch.angular_tremble) / (2 * interval);
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
      dt_s_(dt_s),
      steps_(std::max(1, static_cast<int>(std::ceil(model.sleep.after_s / dt_s - 1e-9)))),
      interval_(std::max(1, steps_ / 4)),
      distance_m_(model.sleep.speed * model.sleep.after_s),
      least_cosine_(core::cosine(std::min(model.sleep.angular_speed * model.sleep.after_s / 2, 1.5))),
      sets_(model.num_bodies()) {
  std::vector<char> has_motor(model.joints.size(), 0);
  for (std::size_t joint = 0; joint < has_motor.size(); ++joint)
    has_motor[joint] = std::ranges::any_of(model.joints[joint].motors, &model::AxisMotor::active);
  for (const model::Event& event : model.events) {
    if (event.kind == model::EventKind::motor) has_motor[static_cast<std::size_t>(event.joint)] = 1;
  }
  for (int joint = 0; joint < model.num_joints(); ++joint) {
    if (has_motor[static_cast<std::size_t>(joint)]) joints_with_motors_.push_back(joint);
  }
}

void Sleepers::start(model::State& state) {
  if (state.rest.empty()) {
    state.rest.resize(state.position.size());
    for (int body = 0; body < state.num_bodies(); ++body) state.rest[body] = model::begin_rest(state, body);
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
      state.rest[body] = model::begin_rest(state, body);
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

bool Sleepers::is_in_balance(const model::MotionWatch& watch, int interval, double step_s,
                             const core::Pose& now) const {
  const model::SleepRule& rule = model_->sleep;
  const auto moves = [&](const Course& course, double tremble, double speed) {
    const double creep_speed = creep * speed;
    return stands_out(course, tremble, interval, step_s, creep_speed,
                      creep_speed / (creep_builds_up * rule.after_s));
  };
  return !moves(way(watch, now), watch.tremble, rule.speed) &&
         !moves(turns(watch, now), watch.angular_tremble, rule.angular_speed);
}

/// A watch is looked at at the end of an interval, once it has lasted for two of them before the last: its
/// count then says whether the body is in balance, until the next look.
bool Sleepers::take_step(model::MotionWatch& watch, int interval, int enough, double step_s,
                         const core::Pose& now) const {
  ++watch.steps;
  if ((watch.steps - enough) % interval != 0) return false;
  if (watch.steps >= enough)
    watch.steps = is_in_balance(watch, interval, step_s, now) ? enough : enough - interval;
  return true;
}

void Sleepers::count(std::span<const int> bodies, model::State& state) const {
  for (const int body : bodies) {
    model::Rest& rest = state.rest[body];
    if (stays(rest, state, body)) {
      rest.idle_steps = std::min(rest.idle_steps + 1, steps_);
      watch(rest, state, body);
    } else {
      rest = model::begin_rest(state, body);
    }
  }
}

void Sleepers::watch(model::Rest& rest, const model::State& state, int body) const {
  const core::Pose now = state.pose(body);
  auto& [brief, extended] = rest.watches;
  add_changes(state.velocity[body] - rest.velocity, state.angular_velocity[body] - rest.angular_velocity,
              interval_, brief);
  rest.velocity = state.velocity[body];
  rest.angular_velocity = state.angular_velocity[body];
  if (!take_step(brief, interval_, steps_, dt_s_, now)) return;
  const double interval_s = interval_ * dt_s_;
  const Course ways = way(brief, now), turned = turns(brief, now);
  brief.knots = {brief.knots[1], now};
  add_changes((ways.second - ways.first) / interval_s, (turned.second - turned.first) / interval_s,
              long_interval, extended);
  if (take_step(extended, long_interval, 2 * long_interval, interval_s, now))
    extended.knots = {extended.knots[1], now};
}

/// Is what the body did in the last interval part of its swaying? Otherwise it may be about to leave.
bool Sleepers::sways(const model::Rest& rest) const {
  const auto& [brief, extended] = rest.watches;
  const auto within = [&](const core::Vec3& moved, double tremble, double speed) {
    const double most = creep * speed + deviations * std::sqrt(tremble / 2);
    return moved.norm() <= most * interval_ * dt_s_ && tremble <= sway * sway * speed * speed;
  };
  const auto& [before, after] = brief.knots;
  return within(after.position - before.position, extended.tremble, model_->sleep.speed) &&
         within(turn(before.orientation, after.orientation), extended.angular_tremble,
                model_->sleep.angular_speed);
}

bool Sleepers::rests(int body, const model::State& state) const {
  const model::Rest& rest = state.rest[body];
  const auto& [brief, extended] = rest.watches;
  if (rest.idle_steps < steps_) return false;
  if (brief.steps >= steps_) return true;
  return extended.steps >= 2 * long_interval && sways(rest);
}

std::vector<Resting> Sleepers::find_resting(std::span<const int> bodies, std::span<const BodyPair> touching,
                                            const IsDriven& is_driven, const model::State& state) {
  std::vector<Resting> resting;
  const auto rests_now = [&](int body) { return rests(body, state); };
  if (std::none_of(bodies.begin(), bodies.end(), rests_now)) return resting;
  find_islands(touching, state);
  restless_.assign(state.position.size(), 0);
  for (const int body : bodies) {
    if (!rests_now(body)) restless_[sets_.find(body)] = 1;
  }
  for (const int joint : joints_with_motors_) {
    const int body = model_->joints[joint].body_a;
    if (rests_now(body) && !state.is_broken(static_cast<std::size_t>(joint)) && is_driven(joint))
      restless_[sets_.find(body)] = 1;
  }
  for (const int body : bodies) {
    const int island = sets_.find(body);
    const bool still =
        model_->gravity.isZero(0) && state.velocity[body].isZero(0) && state.angular_velocity[body].isZero(0);
    if (restless_[island] == 0) resting.push_back({body, island, held_[island] != 0, still});
  }
  return resting;
}

/// Fills sets_, and held_.
void Sleepers::find_islands(std::span<const BodyPair> touching, const model::State& state) {
  sets_.reset(state.num_bodies());
  std::vector<BodyPair> bonds(touching.begin(), touching.end());
  for (std::size_t joint = 0; joint < model_->joints.size(); ++joint) {
    if (!state.is_broken(joint))
      bonds.emplace_back(model_->joints[joint].body_a, model_->joints[joint].body_b);
  }
  for (const auto& [a, b] : bonds) {
    if (a != model::no_body && b != model::no_body) sets_.unite(a, b);
  }
  held_.assign(state.position.size(), 0);
  for (const auto& [a, b] : bonds) {
    if ((a == model::no_body) != (b == model::no_body)) held_[sets_.find(a == model::no_body ? b : a)] = 1;
  }
}

std::vector<Resting> Sleepers::join(int num_bodies, std::span<const Resting> resting,
                                    std::span<const BodyPair> touching) {
  if (resting.empty()) return {};
  model::DisjointSets sets(num_bodies);
  std::vector<const Resting*> rests(static_cast<std::size_t>(num_bodies), nullptr);
  for (const Resting& one : resting) {
    sets.unite(one.body, one.island);
    rests[one.body] = &one;
  }
  for (const auto& [a, b] : touching) {
    if (a != model::no_body && b != model::no_body) sets.unite(a, b);
  }
  std::vector<char> restless(rests.size(), 0), held(rests.size(), 0), moves(rests.size(), 0);
  for (const auto& [a, b] : touching) {
    for (const int body : {a, b}) {
      if (body == model::no_body) continue;
      restless[sets.find(body)] |= rests[body] == nullptr;
      held[sets.find(body)] |= a == model::no_body || b == model::no_body;
    }
  }
  for (const Resting& one : resting) {
    held[sets.find(one.body)] |= one.held;
    moves[sets.find(one.body)] |= !one.still;
  }
  std::vector<Resting> joined;
  for (int body = 0; body < num_bodies; ++body) {
    const int island = sets.find(body);
    if (rests[body] == nullptr || restless[island] || (moves[island] && !held[island])) continue;
    joined.push_back({body, island, held[island] != 0, rests[body]->still});
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
