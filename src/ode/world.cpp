#include "ode/world.h"

#include <cmath>
#include <utility>

#include "core/error.h"
#include "core/random.h"
#include "ode/objects/bodies.h"
#include "ode/objects/joints.h"
#include "stepping/observable_table.h"

namespace pbmpi::ode {
namespace {

/// ODE scales velocities by 1 - scale after each step; the threshold is one below which it does not.
void set_damping(dWorldID world, const model::Model& model, double dt_s) {
  dWorldSetLinearDamping(world, -std::expm1(-model.linear_damping * dt_s));
  dWorldSetAngularDamping(world, -std::expm1(-model.angular_damping * dt_s));
  dWorldSetLinearDampingThreshold(world, 0);
  dWorldSetAngularDampingThreshold(world, 0);
}

/// Before the bodies and joints: ODE's copy ERP, CFM and damping when they are made.
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

}  // namespace

World::World(int id, const model::Model& model, const model::State& state, std::int64_t step,
             const stepping::StepperSettings& settings, const SolverResources& resources)
    : id_(id),
      model_(&model),
      plan_(model),
      settings_(settings),
      world_(make_world(model, settings, resources)),
      bodies_(make_bodies(world_.get(), model)),
      joints_(make_joints(world_.get(), bodies_, model, settings.dt_s)),
      held_poses_(model, joints_),
      events_(model, bodies_, joints_, held_poses_),
      breaking_(model, joints_, plan_.has(effects::EffectId::breakable_joints)),
      contacts_(model, plan_, bodies_),
      row_counter_(model, joints_),
      step_(step) {
  if (plan_.has(effects::EffectId::collision))
    broad_phase_.emplace(model, bodies_, best_space(model.geoms.size()));
  if (plan_.has(effects::EffectId::fast_bodies)) fast_bodies_.emplace(model);
  if (plan_.has(effects::EffectId::field_of_interest) && settings.kind == stepping::StepperKind::quick)
    focus_.emplace(model, bodies_, settings.iterations);
  if (fast_bodies_ || focus_) before_step_.resize(model.num_bodies());
  if (plan_.has(effects::EffectId::sleeping)) {
    core::require_input(!settings.profile,
                        "the islands of a step are timed one by one, and with the effect 'sleeping' some are "
                        "not stepped; leave one of the two out");
    sleeping_.emplace(model, settings.dt_s, bodies_);
  }
  events_.skip_to(step);
  set_state(state);
}

void World::set_state(const model::State& state) {
  moved_ = true;
  restore(bodies_, state);
  if (sleeping_) sleeping_->start(state);
  if (breaking_.start(state.broken_in)) show_broken();
}

void World::show_broken() {
  if (broad_phase_) broad_phase_->set_broken(*model_, broken_in());
  if (fast_bodies_) fast_bodies_->set_broken(broken_in());
  if (sleeping_) sleeping_->set_broken(broken_in());
  if (focus_) focus_->set_broken(*model_, broken_in());
}

void World::advance(int num_steps, core::LapTimer& timer, MessageLog& log) {
  for (int i = 0; i < num_steps; ++i) {
    log.set_place(id_, step_);
    take_step(i + 1 == num_steps, timer);
  }
}

/// A step of a world in which all bodies sleep, and that no event wakes, changes nothing.
bool World::sleeps_on() {
  if (!sleeping_) return false;
  sleeping_->wake_called(step_);
  return sleeping_->all_asleep();
}

void World::take_step(bool is_last, core::LapTimer& timer) {
  if (sleeps_on()) {
    contacts_.forget();
    if (focus_) focus_->look({}, before_step_, contacts_.touches());
    if (is_last && moved_) row_counter_.count(contacts_.touches(), sleeping_->rest(), broken_in(), counts_);
    ++step_;
    return;
  }
  moved_ = true;
  events_.fire(step_);
  held_poses_.aim(settings_.dt_s);
  if (is_last && settings_.profile) {
    before_last_.resize(model_->num_bodies());
    copy_out(bodies_, before_last_);
    before_last_.broken_in = broken_in();
  }
  if (broad_phase_) {
    collide();
    timer.lap(core::Phase::collide);
  }
  if (is_last) {
    row_counter_.count(contacts_.touches(), rest(), broken_in(), counts_);
    timer.lap(core::Phase::islands);
  }
  if (focus_) {
    copy_out(bodies_, before_step_);
    focus_->look(sleeping_ ? sleeping_->awake() : focus_->all_bodies(), before_step_, contacts_.touches());
    timer.lap(core::Phase::islands);
  }
  breaking_.note_places();
  solve();
  if (breaking_.strain(step_, rest())) show_broken();
  contacts_.clear();
  timer.lap(core::Phase::solve);
  if (sleeping_) {
    sleeping_->settle(contacts_.touches());
    timer.lap(core::Phase::islands);
  }
  ++step_;
}

std::span<const model::Rest> World::rest() const {
  return sleeping_ ? std::span<const model::Rest>(sleeping_->rest()) : std::span<const model::Rest>();
}

/// Again while contacts wake what slept, since its own contacts are then to be found, too.
void World::collide() {
  const std::vector<GeomPair>& pairs = broad_phase_->find_pairs();
  do {
    contacts_.clear();
    contacts_.make(world_.get(), sleeping_ ? sleeping_->awake_pairs(pairs) : pairs, broad_phase_->geoms());
    if (fast_bodies_) look_ahead();
  } while (sleeping_ && sleeping_->wake_touched(contacts_.touches()));
}

void World::look_ahead() {
  copy_out(bodies_, before_step_);
  if (!fast_bodies_->look(before_step_, settings_.dt_s)) return;
  ahead_.clear();
  fast_bodies_->add(
      before_step_, [](int, int) { return true; }, ahead_);
  contacts_.make_ahead(world_.get(), ahead_, settings_.dt_s);
}

/// Islands outside of a field of interest by themselves: ODE takes what is enabled.
void World::solve() {
  if (!focus_ || !focus_->is_cut())
    return solve_enabled(focus_ ? focus_->iterations() : settings_.iterations);
  focus_->enable_outside();
  solve_enabled(focus_->field().outside_iterations());
  focus_->enable_inside();
  solve_enabled(settings_.iterations);
  focus_->enable_both();
}

/// QuickStep shuffles its rows by one random seed of the whole process, so that it is set anew each time.
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

void World::read(model::State& state, stepping::Observables& observables) {
  if (!std::exchange(moved_, false)) return stepping::observe_sleep(observables);
  copy_out(bodies_, state);
  if (sleeping_) state.rest = sleeping_->rest();
  state.broken_in = broken_in();
  observables = counts_;
  observables.contacts = contacts_.count();
  observables.bodies_inside = focus_ ? static_cast<int>(focus_->field().inside().size()) : 0;
  observables.max_penetration_m = contacts_.deepest_m();
  stepping::observe_state(*model_, state, observables);
}

}  // namespace pbmpi::ode
