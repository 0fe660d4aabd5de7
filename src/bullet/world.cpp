#include "bullet/world.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/marks.h"
#include "stepping/observable_table.h"

namespace pbmpi::bullet {
namespace {

std::vector<int> measured_joints(const model::Model& model, bool all, std::span<const int> breakable) {
  if (!all) return {breakable.begin(), breakable.end()};
  std::vector<int> joints(model.joints.size());
  std::iota(joints.begin(), joints.end(), 0);
  return joints;
}

}  // namespace

World::World(const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
             std::int64_t step, const stepping::StepperSettings& settings, Collider& collider)
    : model_(&model),
      observer_(model),
      targets_(&targets),
      plan_(model),
      settings_(settings),
      bodies_(model),
      slow_bounds_(effects::slow_bounds(model)),
      joints_(model, bodies_),
      held_poses_(model, joints_),
      events_(model, bodies_, joints_, held_poses_),
      state_(state),
      rules_(model, settings.dt_s, std::nullopt, effects::StepRules::World::whole, state_),
      loads_(model, bodies_, joints_, measured_joints(model, settings.contacts, rules_.breakable_joints())),
      no_pairs_(model.num_bodies() + 1),
      world_(model, bodies_, joints_, collider, no_pairs_),
      shapes_(model, bodies_),
      pairs_(model, shapes_),
      contacts_(model, plan_, shapes_, bodies_, collider, world_.collision_info(), settings.dt_s),
      row_counter_(model, joints_),
      linear_keep_(std::exp(-model.linear_damping * settings.dt_s)),
      angular_keep_(std::exp(-model.angular_damping * settings.dt_s)),
      step_(step) {
  events_.skip_to(step);
  for (const stepping::MotorTargets::Target& target : targets.all())
    events_.set_motor(target.joint, target.axis, target.motor);
  set_state(state);
}

void World::set_state(const model::State& state) {
  moved_ = true;
  bodies_.restore(state);
  state_ = state;
  if (rules_.sleepers() == nullptr) state_.rest.clear();
  const bool other_joints_hold = rules_.start();
  if (rules_.sleepers() != nullptr) show_awake();
  if (other_joints_hold) show_broken();
}

void World::aim(const stepping::MotorTargets::Target& target) {
  events_.set_motor(target.joint, target.axis, target.motor);
  if (rules_.sleepers() == nullptr) return;
  const model::Joint& joint = model_->joints[static_cast<std::size_t>(target.joint)];
  if (rules_.sleepers()->wake_islands_of(std::array{joint.body_a, joint.body_b})) show_awake();
}

void World::fire_events(std::int64_t step) {
  events_.fire(step);
  targets_->pass(*model_, step);
}

void World::show_broken() {
  for (int joint = 0; joint < joints_.size(); ++joint)
    joints_[joint].setEnabled(!state_.is_broken(static_cast<std::size_t>(joint)));
  pairs_.set_broken(state_.broken_in);
}

void World::show_awake() {
  for (int body = 0; body < bodies_.size(); ++body)
    bodies_.show_awake(body, !state_.rest[static_cast<std::size_t>(body)].asleep());
}

void World::show_asleep(std::span<const int> bodies) {
  for (const int body : bodies) {
    bodies_.set_velocity(body, model::Vec3::Zero(), model::Vec3::Zero());
    bodies_.show_awake(body, false);
  }
}

void World::store(std::span<const int>, model::State& state) const { bodies_.copy_out(state); }

void World::set_velocities(std::span<const int> bodies, const model::State& state) {
  for (const int body : bodies) {
    const auto at = static_cast<std::size_t>(body);
    bodies_.set_velocity(body, state.velocity[at], state.angular_velocity[at]);
  }
}

std::span<const effects::BodyPair> World::touching() {
  touching_.clear();
  for (const Touch& touch : contacts_.touches()) touching_.emplace_back(touch.body_a, touch.body_b);
  return touching_;
}

bool World::may_be_fast() const {
  for (int i = 0; i < bodies_.size(); ++i) {
    const model::Vec3 v = vec3(bodies_[i].getLinearVelocity()), w = vec3(bodies_[i].getAngularVelocity());
    if (!slow_bounds_[static_cast<std::size_t>(i)].holds(v, w, settings_.dt_s)) return true;
  }
  return false;
}

void World::add_speculative_contacts(effects::FastBodies& fast, const model::State& before) {
  ahead_.clear();
  fast.add(
      before, [](int, int) { return true; }, ahead_);
  contacts_.make_ahead(ahead_);
}

bool World::advance(int num_steps, core::LapTimer& timer) {
  for (int i = 0; i < num_steps; ++i) {
    if (!is_finite() || !take_step(i + 1 == num_steps, timer)) return false;
  }
  return true;
}

bool World::take_step(bool is_last, core::LapTimer& timer) {
  rules_.begin_step(*this, step_);
  if (rules_.all_asleep()) {
    sleep_on(is_last);
    return true;
  }
  moved_ = true;
  joints_.follow();
  held_poses_.aim(settings_.dt_s);
  if (is_last && settings_.contacts) note_centres();
  if (plan_.has(effects::EffectId::collision)) {
    collide();
    timer.lap(core::Phase::collide);
  }
  if (is_last) row_counter_.count(contacts_.touches(), state_, counts_);
  rules_.before_solve(*this);
  loads_.note_places();
  timer.lap(core::Phase::islands);
  {
    const core::PhaseMark mark(core::PhaseMark::MarkedPhase::forward_step);
    world_.step(settings_.dt_s, settings_.iterations);
  }
  settle();
  if (is_last && settings_.contacts) show_contacts();
  contacts_.clear();
  timer.lap(core::Phase::solve);
  if (!is_finite()) return false;
  rules_.after_solve(*this, step_);
  timer.lap(core::Phase::islands);
  ++step_;
  return true;
}

/// A step of a world in which all bodies sleep and that no event wakes changes nothing.
void World::sleep_on(bool is_last) {
  contacts_.forget();
  shown_.clear();
  rules_.sleep_on();
  if (is_last && moved_) row_counter_.count(contacts_.touches(), state_, counts_);
  counts_.row_visits = 0;
  ++step_;
}

void World::collide() {
  const core::PhaseMark mark(core::PhaseMark::MarkedPhase::collision);
  shapes_.move();
  const std::vector<model::GeomPair>& pairs = pairs_.find();
  do {
    contacts_.make(awake_pairs(pairs));
  } while (rules_.after_collision(*this));
}

/// The pairs with at least one awake geom.
const std::vector<model::GeomPair>& World::awake_pairs(const std::vector<model::GeomPair>& pairs) {
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

/// Applies damping after the step, as ODE does: Bullet's own is a power of 1 - d, not exp(-d t).
void World::settle() {
  for (const int body : rules_.awake()) {
    bodies_.settle(body);
    bodies_.set_velocity(body, linear_keep_ * vec3(bodies_[body].getLinearVelocity()),
                         angular_keep_ * vec3(bodies_[body].getAngularVelocity()));
  }
}

bool World::is_finite() const {
  return std::ranges::all_of(rules_.awake(), [&](int body) { return bodies_.is_finite(body); });
}

void World::note_centres() {
  centres_.clear();
  for (int body = 0; body < bodies_.size(); ++body)
    centres_.push_back(vec3(bodies_[body].getCenterOfMassPosition()));
}

void World::show_contacts() {
  shown_.clear();
  contacts_.show(centres_, shown_.contacts, shown_.forces);
  for (int joint = 0; joint < joints_.size(); ++joint) shown_.joints.push_back(loads_.force(joint));
}

void World::read(model::State& state, stepping::Observables& observables) {
  if (!std::exchange(moved_, false)) return stepping::observe_sleep(observables);
  bodies_.copy_out(state);
  if (rules_.sleepers() != nullptr) state.rest = state_.rest;
  state.broken_in = state_.broken_in;
  observables = counts_;
  observables.row_visits = static_cast<double>(counts_.rows) * settings_.iterations;
  observables.contacts = contacts_.count();
  observables.fast_bodies = rules_.num_fast();
  observables.max_penetration_m = std::max(0.0, contacts_.deepest_m());
  observer_.observe(state, observables);
}

}  // namespace pbmpi::bullet
