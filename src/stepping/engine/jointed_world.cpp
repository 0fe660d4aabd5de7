#include "stepping/engine/jointed_world.h"

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.h"
#include "model/joint_traits.h"
#include "model/validate.h"
#include "stepping/observable_table.h"

namespace pbmpi::stepping {
namespace {

/// Is it a setting of a joint's axis? Releases are handled by effects::Breakage.
bool is_setting(const model::Event& event) {
  return event.kind == model::EventKind::motor || event.kind == model::EventKind::steer;
}

void require_drivable(const model::Model& model) {
  for (const model::Event& event : model.events) {
    if (!is_setting(event)) continue;
    const model::Joint& joint = model.joints[static_cast<std::size_t>(event.joint)];
    const int axis = event.kind == model::EventKind::steer ? 0 : event.axis;
    core::require_input(model::traits_of(joint.kind).axes[static_cast<std::size_t>(axis)].has_motor,
                        "event of step " + std::to_string(event.step) + ": joint '" + joint.name +
                            "' has no axis " + std::to_string(axis + 1) + " to drive; name another joint");
  }
}

}  // namespace

void RowCounter::count(const std::vector<Touch>& touches, const model::State& state,
                       const RowsOfJoint& rows_of_joint, Observables& observables) {
  collect(touches, state, rows_of_joint);
  const int num_bodies = model_->num_bodies();
  sets_.reset(num_bodies);
  for (const Link& link : links_) {
    if (link.body_a != model::no_body && link.body_b != model::no_body) sets_.unite(link.body_a, link.body_b);
  }
  set_rows_.assign(static_cast<std::size_t>(num_bodies), 0);
  observables.rows = 0;
  for (const Link& link : links_) {
    const int body = sets_.find(link.body_a != model::no_body ? link.body_a : link.body_b);
    set_rows_[static_cast<std::size_t>(body)] += link.rows;
    observables.rows += link.rows;
  }
  observables.max_island_rows = *std::max_element(set_rows_.begin(), set_rows_.end());
  observables.islands = 0;
  for (int body = 0; body < num_bodies; ++body) observables.islands += sets_.find(body) == body ? 1 : 0;
}

std::vector<IslandCost> RowCounter::islands(const std::vector<Touch>& touches) {
  std::vector<IslandCost> by_body(static_cast<std::size_t>(model_->num_bodies()));
  const auto island_with = [&](int body) -> IslandCost& {
    return by_body[static_cast<std::size_t>(sets_.find(body))];
  };
  for (int body = 0; body < model_->num_bodies(); ++body) ++island_with(body).bodies;
  for (const Touch& touch : touches)
    island_with(touch.body_a != model::no_body ? touch.body_a : touch.body_b).contacts += touch.num_contacts;
  std::vector<IslandCost> islands;
  for (std::size_t body = 0; body < by_body.size(); ++body) {
    if (by_body[body].bodies == 0) continue;
    by_body[body].first_body = static_cast<int>(body);
    by_body[body].rows = set_rows_[body];
    islands.push_back(by_body[body]);
  }
  return islands;
}

void RowCounter::collect(const std::vector<Touch>& touches, const model::State& state,
                         const RowsOfJoint& rows_of_joint) {
  links_.clear();
  const auto asleep = [&](int body) {
    return !state.rest.empty() && state.rest[static_cast<std::size_t>(body)].asleep();
  };
  for (int body = 0; body < model_->num_bodies(); ++body) {
    if (asleep(body)) links_.push_back({body, state.rest[static_cast<std::size_t>(body)].island(), 0});
  }
  for (int i = 0; i < model_->num_joints(); ++i) {
    if (state.is_broken(static_cast<std::size_t>(i))) continue;
    const model::Joint& joint = model_->joints[static_cast<std::size_t>(i)];
    links_.push_back({joint.body_a, joint.body_b, asleep(joint.body_a) ? 0 : rows_of_joint(i)});
  }
  for (const Touch& touch : touches)
    links_.push_back({touch.body_a, touch.body_b, touch.num_contacts * touch.rows_per_contact});
}

JointedWorld::JointedWorld(const model::Model& model, MotorTargets& targets, const model::State& state,
                           std::int64_t step, const StepperSettings& settings, std::optional<int> iterations)
    : EngineWorld(model, targets, state, step, settings, iterations),
      row_counter_(model),
      slow_bounds_(effects::slow_bounds(model)) {
  for (int j = 0; j < model.num_joints(); ++j) {
    const model::Joint& joint = model.joints[static_cast<std::size_t>(j)];
    model::require_kind_has(joint);
    for (int axis = 0; axis < 2; ++axis) hold(j, axis, joint.motors[static_cast<std::size_t>(axis)]);
  }
}

void JointedWorld::start(const model::State& state) {
  require_drivable(*model_);
  for (; next_event_ < model_->events.size() && model_->events[next_event_].step < step_; ++next_event_) {
    // launches of earlier steps are already part of the state
    if (is_setting(model_->events[next_event_])) apply(model_->events[next_event_]);
  }
  for (const MotorTargets::Target& target : targets_->all())
    set_motor(target.joint, target.axis, target.motor);
  set_state(state);
}

void JointedWorld::set_state(const model::State& state) {
  moved_ = true;
  restore(state);
  state_ = state;
  if (rules_.sleepers() == nullptr) state_.rest.clear();
  const bool other_joints_hold = rules_.start();
  if (rules_.sleepers() != nullptr) show_awake();
  if (other_joints_hold) show_broken();
}

void JointedWorld::aim(const MotorTargets::Target& target) {
  set_motor(target.joint, target.axis, target.motor);
  if (rules_.sleepers() == nullptr) return;
  const model::Joint& joint = model_->joints[static_cast<std::size_t>(target.joint)];
  if (rules_.sleepers()->wake_islands_of(std::array{joint.body_a, joint.body_b})) show_awake();
}

void JointedWorld::read(model::State& state, Observables& observables) {
  if (!std::exchange(moved_, false)) return observe_sleep(observables);
  store(rules_.all_bodies(), state);
  if (rules_.sleepers() != nullptr) state.rest = state_.rest;
  state.broken_in = state_.broken_in;
  observables = counts_;
  observables.contacts = count_contacts(touches());
  observables.fast_bodies = rules_.num_fast();
  observables.bodies_inside = rules_.num_inside();
  observables.max_penetration_m = std::max(0.0, deepest_m());
  observer_.observe(state, observables);
}

void JointedWorld::fire_events(std::int64_t step) {
  while (next_event_ < model_->events.size() && model_->events[next_event_].step <= step)
    apply(model_->events[next_event_++]);
  targets_->pass(*model_, step);
}

void JointedWorld::apply(const model::Event& event) {
  switch (event.kind) {
    case model::EventKind::motor:
      return set_motor(event.joint, event.axis, event.motor);
    case model::EventKind::steer:
      return limit(event.joint, {event.angle, event.angle});
    case model::EventKind::launch:
      return launch(event);
    case model::EventKind::release:
      return;
  }
}

void JointedWorld::set_motor(int joint, int axis, const model::AxisMotor& motor) {
  drive(joint, axis, motor);
  hold(joint, axis, motor);
}

/// Without a hold rate the target of the axis is no longer updated.
void JointedWorld::hold(int joint, int axis, const model::AxisMotor& motor) {
  std::erase_if(held_, [&](const Held& held) { return held.joint == joint && held.axis == axis; });
  if (motor.active() && motor.hold_rate > 0) held_.push_back({joint, axis, motor});
}

/// A rate above 1 / dt would overshoot.
void JointedWorld::aim_held() {
  for (const Held& held : held_) {
    model::AxisMotor motor = held.motor;
    motor.velocity -= std::min(motor.hold_rate, 1 / settings_.dt_s) * coordinate(held.joint, held.axis);
    drive(held.joint, held.axis, motor);
  }
}

std::span<const effects::BodyPair> JointedWorld::touching() {
  touching_.clear();
  for (const Touch& touch : touches()) touching_.emplace_back(touch.body_a, touch.body_b);
  return touching_;
}

void JointedWorld::sleep_on(bool is_last) {
  forget_contacts();
  rules_.sleep_on();
  if (is_last && moved_) count();
  counts_.row_visits = 0;
  ++step_;
}

const std::vector<model::GeomPair>& JointedWorld::awake_pairs(const std::vector<model::GeomPair>& pairs) {
  if (rules_.sleepers() == nullptr) return pairs;
  awake_pairs_.clear();
  const auto awake = [&](int geom) {
    const int body = model_->geoms[static_cast<std::size_t>(geom)].body;
    return body != model::no_body && !state_.rest[static_cast<std::size_t>(body)].asleep();
  };
  for (const model::GeomPair& pair : pairs) {
    if (awake(pair.first) || awake(pair.second)) awake_pairs_.push_back(pair);
  }
  return awake_pairs_;
}

bool JointedWorld::may_be_fast() const {
  for (int body = 0; body < model_->num_bodies(); ++body) {
    const Velocities v = velocities(body);
    if (!slow_bounds_[static_cast<std::size_t>(body)].holds(v.linear, v.angular, settings_.dt_s)) return true;
  }
  return false;
}

void JointedWorld::add_speculative_contacts(effects::FastBodies& fast, const model::State& before) {
  ahead_.clear();
  fast.add(
      before, [](int, int) { return true; }, ahead_);
  make_ahead(ahead_);
}

void JointedWorld::note_centres() {
  centres_.clear();
  for (int body = 0; body < model_->num_bodies(); ++body) centres_.push_back(centre(body));
}

void JointedWorld::show_contacts() {
  shown_.clear();
  append_contacts(centres_, shown_.contacts);
  for (int joint = 0; joint < model_->num_joints(); ++joint) shown_.joints.push_back(joint_force(joint));
}

void JointedWorld::count() {
  row_counter_.count(
      touches(), state_, [this](int joint) { return count_rows(joint); }, counts_);
}

}  // namespace pbmpi::stepping
