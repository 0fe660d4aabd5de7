#include "ode/world.h"

#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/marks.h"
#include "core/random.h"
#include "ode/objects/bodies.h"
#include "ode/objects/joints.h"
#include "ode/objects/numbers.h"
#include "stepping/observable_table.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::ode {
namespace {

/// ODE scales velocities by 1 - scale after each step; it would not below the threshold, which is therefore
/// 0.
void set_damping(dWorldID world, const model::Model& model, double dt_s) {
  dWorldSetLinearDamping(world, -std::expm1(-model.linear_damping * dt_s));
  dWorldSetAngularDamping(world, -std::expm1(-model.angular_damping * dt_s));
  dWorldSetLinearDampingThreshold(world, 0);
  dWorldSetAngularDampingThreshold(world, 0);
}

/// To be called before bodies and joints are made: ODE's copy ERP, CFM and damping then.
WorldHandle make_world(const model::Model& model, const stepping::StepperSettings& settings,
                       const SolverResources& resources) {
  WorldHandle world = resources.make_world();
  dWorldSetGravity(world.get(), model.gravity.x(), model.gravity.y(), model.gravity.z());
  dWorldSetERP(world.get(), model.erp);
  dWorldSetCFM(world.get(), model.cfm);
  dWorldSetAutoDisableFlag(world.get(), 0);
  set_damping(world.get(), model, settings.dt_s);
  return world;
}

/// dWorldStep has no iterations.
std::optional<int> iterations_of(const stepping::StepperSettings& settings) {
  return settings.kind == stepping::StepperKind::quick ? std::optional(settings.iterations) : std::nullopt;
}

std::vector<int> joints_in(std::span<const int> joints) { return {joints.begin(), joints.end()}; }

std::vector<int> all_joints(const model::Model& model) {
  std::vector<int> joints(model.joints.size());
  std::iota(joints.begin(), joints.end(), 0);
  return joints;
}

}  // namespace

World::World(int id, const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
             std::int64_t step, const stepping::StepperSettings& settings, const SolverResources& resources)
    : id_(id),
      model_(&model),
      observer_(model),
      targets_(&targets),
      plan_(model),
      settings_(settings),
      world_(make_world(model, settings, resources)),
      bodies_(make_bodies(world_.get(), model)),
      slow_bounds_(effects::slow_bounds(model)),
      joints_(make_joints(world_.get(), bodies_, model, settings.dt_s)),
      held_poses_(model, joints_),
      events_(model, bodies_, joints_, held_poses_),
      state_(state),
      rules_(model, settings.dt_s, iterations_of(settings), effects::StepRules::World::whole, state_),
      loads_(model, joints_, settings.contacts ? all_joints(model) : joints_in(rules_.breakable_joints())),
      contacts_(model, plan_, bodies_),
      row_counter_(model, joints_),
      step_(step) {
  core::require_input(!settings.profile || rules_.sleepers() == nullptr,
                      "the islands of a step are timed one by one, and with the effect 'sleeping' some are "
                      "not stepped; leave one of the two out");
  if (plan_.has(effects::EffectId::collision))
    broad_phase_.emplace(model, bodies_, best_space(model.geoms.size()));
  if (rules_.field() != nullptr) focus_.emplace(*rules_.field(), bodies_);
  events_.skip_to(step);
  for (const stepping::MotorTargets::Target& target : targets_->all())
    events_.set_motor(target.joint, target.axis, target.motor);
  set_state(state);
}

void World::set_state(const model::State& state) {
  moved_ = true;
  restore(bodies_, state);
  state_ = state;
  if (rules_.sleepers() == nullptr) state_.rest.clear();
  const bool other_joints_hold = rules_.start();
  if (rules_.sleepers() != nullptr) show_awake();
  if (other_joints_hold) show_broken();
}

void World::aim(const stepping::MotorTargets::Target& target) {
  events_.set_motor(target.joint, target.axis, target.motor);
  if (rules_.sleepers() == nullptr) return;
  const model::Joint& joint = model_->joints[target.joint];
  if (rules_.sleepers()->wake_islands_of(std::array{joint.body_a, joint.body_b})) show_awake();
}

void World::fire_events(std::int64_t step) {
  events_.fire(step);
  targets_->pass(*model_, step);
}

void World::set_broken(const std::vector<std::int32_t>& broken_in) {
  state_.broken_in = broken_in;
  if (rules_.start()) show_broken();
}

void World::show_broken() {
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    state_.is_broken(joint) ? dJointDisable(joints_[joint]) : dJointEnable(joints_[joint]);
  if (broad_phase_) broad_phase_->set_broken(*model_, state_.broken_in);
}

void World::show_awake() {
  for (std::size_t body = 0; body < bodies_.size(); ++body)
    state_.rest[body].asleep() ? dBodyDisable(bodies_[body]) : dBodyEnable(bodies_[body]);
}

void World::show_asleep(std::span<const int> bodies) {
  for (const int body : bodies) {
    dBodySetLinearVel(bodies_[body], 0, 0, 0);
    dBodySetAngularVel(bodies_[body], 0, 0, 0);
    dBodyDisable(bodies_[body]);
  }
}

void World::store(std::span<const int>, model::State& state) const { copy_out(bodies_, state); }

void World::set_velocities(std::span<const int> bodies, const model::State& state) {
  for (const int body : bodies) {
    const model::Vec3 &v = state.velocity[body], &w = state.angular_velocity[body];
    dBodySetLinearVel(bodies_[body], v.x(), v.y(), v.z());
    dBodySetAngularVel(bodies_[body], w.x(), w.y(), w.z());
  }
}

std::span<const effects::BodyPair> World::touching() {
  touching_.clear();
  for (const Touch& touch : contacts_.touches()) touching_.emplace_back(touch.body_a, touch.body_b);
  return touching_;
}

void World::advance(int num_steps, core::LapTimer& timer, MessageLog& log) {
  for (int i = 0; i < num_steps; ++i) {
    log.set_place(id_, step_);
    take_step(i + 1 == num_steps, timer);
  }
}

void World::take_step(bool is_last, core::LapTimer& timer) {
  rules_.begin_step(*this, step_);
  if (rules_.all_asleep()) return sleep_on(is_last);
  moved_ = true;
  held_poses_.aim(settings_.dt_s);
  if (is_last && settings_.profile) {
    before_last_.resize(model_->num_bodies());
    copy_out(bodies_, before_last_);
    before_last_.broken_in = broken_in();
  }
  contacts_.keep(is_last && settings_.contacts);
  if (is_last && settings_.contacts) note_centres();
  if (broad_phase_) {
    collide();
    timer.lap(core::Phase::collide);
  }
  if (is_last) {
    row_counter_.count(contacts_.touches(), rest(), broken_in(), counts_);
    timer.lap(core::Phase::islands);
  }
  rules_.before_solve(*this);
  if (is_last) counts_.row_visits = row_counter_.row_visits([&](int body) { return sweeps_of(body); });
  loads_.note_places();
  timer.lap(core::Phase::islands);
  solve();
  contacts_.clear();
  if (is_last && settings_.contacts) show_contacts();
  timer.lap(core::Phase::solve);
  rules_.after_solve(*this, step_);
  timer.lap(core::Phase::islands);
  ++step_;
}

/// A step of a world in which all bodies sleep and that no event wakes changes nothing.
void World::sleep_on(bool is_last) {
  contacts_.forget();
  shown_.contacts.clear();
  shown_.forces.clear();
  rules_.sleep_on();
  if (is_last && moved_) row_counter_.count(contacts_.touches(), rest(), broken_in(), counts_);
  counts_.row_visits = 0;
  ++step_;
}

int World::sweeps_of(int body) const {
  if (!stepping::traits_of(settings_.kind).iterates) return 1;
  return rules_.field() != nullptr ? rules_.field()->iterations_of(body) : settings_.iterations;
}

std::span<const model::Rest> World::rest() const { return state_.rest; }

void World::collide() {
  const core::PhaseMark mark(core::PhaseMark::MarkedPhase::collision);
  const std::vector<GeomPair>& pairs = broad_phase_->find_pairs();
  do {
    contacts_.clear();
    contacts_.make(world_.get(), awake_pairs(pairs), broad_phase_->geoms());
  } while (rules_.after_collision(*this));
}

/// The pairs with at least one awake geom.
const std::vector<GeomPair>& World::awake_pairs(const std::vector<GeomPair>& pairs) {
  if (rules_.sleepers() == nullptr) return pairs;
  awake_pairs_.clear();
  const auto awake = [&](int geom) {
    const int body = model_->geoms[geom].body;
    return body != model::no_body && !state_.rest[body].asleep();
  };
  for (const GeomPair& pair : pairs) {
    if (awake(pair.first) || awake(pair.second)) awake_pairs_.push_back(pair);
  }
  return awake_pairs_;
}

bool World::may_be_fast() const {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const dReal *v = dBodyGetLinearVel(bodies_[i]), *w = dBodyGetAngularVel(bodies_[i]);
    if (!slow_bounds_[i].holds({v[0], v[1], v[2]}, {w[0], w[1], w[2]}, settings_.dt_s)) return true;
  }
  return false;
}

void World::add_speculative_contacts(effects::FastBodies& fast, const model::State& before) {
  ahead_.clear();
  fast.add(
      before, [](int, int) { return true; }, ahead_);
  contacts_.make_ahead(world_.get(), ahead_, settings_.dt_s);
}

/// Steps the islands outside of a field of interest on their own: ODE steps what is enabled.
void World::solve() {
  const core::PhaseMark mark(core::PhaseMark::MarkedPhase::forward_step);
  if (!focus_ || !focus_->is_cut())
    return solve_enabled(focus_ ? focus_->iterations() : settings_.iterations);
  focus_->enable_outside();
  solve_enabled(focus_->outside_iterations());
  focus_->enable_inside();
  solve_enabled(settings_.iterations);
  focus_->enable_both();
}

/// QuickStep shuffles its rows with one random seed for the whole process, so the seed is set anew each time.
void World::solve_enabled(int iterations) {
  if (settings_.kind == stepping::StepperKind::quick) {
    dWorldSetQuickStepNumIterations(world_.get(), iterations);
    dRandSetSeed(
        core::mix_key(settings_.seed, static_cast<std::uint64_t>(id_), static_cast<std::uint64_t>(step_)));
    dWorldQuickStep(world_.get(), settings_.dt_s);
  } else {
    dWorldStep(world_.get(), settings_.dt_s);
  }
}

void World::note_centres() {
  centres_.clear();
  for (const dBodyID body : bodies_) centres_.push_back(vec3(dBodyGetPosition(body)));
}

void World::show_contacts() {
  shown_.clear();
  contacts_.show(centres_, shown_.contacts, shown_.forces);
  for (std::size_t joint = 0; joint < joints_.size(); ++joint)
    shown_.joints.push_back(loads_.force(static_cast<int>(joint)));
}

void World::read(model::State& state, stepping::Observables& observables) {
  if (!std::exchange(moved_, false)) return stepping::observe_sleep(observables);
  copy_out(bodies_, state);
  if (rules_.sleepers() != nullptr) state.rest = state_.rest;
  state.broken_in = broken_in();
  observables = counts_;
  observables.contacts = contacts_.count();
  observables.fast_bodies = rules_.num_fast();
  observables.bodies_inside = rules_.num_inside();
  observables.max_penetration_m = contacts_.deepest_m();
  observer_.observe(state, observables);
}

}  // namespace pbmpi::ode
