#include "ode/world.h"

#include <cmath>

#include "core/error.h"
#include "core/marks.h"
#include "core/random.h"
#include "ode/objects/bodies.h"
#include "ode/objects/joints.h"
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

/// ODE normalises the quaternion in the same way each time, so a restart before or after the launch changes
/// nothing.
void place(dBodyID body, const model::Pose& pose) {
  dBodySetPosition(body, pose.position.x(), pose.position.y(), pose.position.z());
  const dQuaternion q = {real(pose.orientation.w), real(pose.orientation.x), real(pose.orientation.y),
                         real(pose.orientation.z)};
  dBodySetQuaternion(body, q);
}

void set_velocity(dBodyID body, const model::Vec3& v, const model::Vec3& w) {
  dBodySetLinearVel(body, v.x(), v.y(), v.z());
  dBodySetAngularVel(body, w.x(), w.y(), w.z());
}

}  // namespace

World::World(int id, const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
             std::int64_t step, const stepping::StepperSettings& settings, const SolverResources& resources,
             MessageLog& log)
    : JointedWorld(model, targets, state, step, settings, iterations_of(settings)),
      id_(id),
      log_(&log),
      world_(make_world(model, settings, resources)),
      bodies_(make_bodies(world_.get(), model)),
      joints_(make_joints(world_.get(), bodies_, model, settings.dt_s)),
      loads_(model, joints_, measured_joints()),
      contacts_(model, plan_, bodies_) {
  core::require_input(!settings.profile || rules_.sleepers() == nullptr,
                      "the islands of a step are timed one by one, and with the effect 'sleeping' some are "
                      "not stepped; leave one of the two out");
  if (plan_.has(effects::EffectId::collision))
    broad_phase_.emplace(model, bodies_, best_space(model.geoms.size()));
  if (rules_.field() != nullptr) focus_.emplace(*rules_.field(), bodies_);
  start(state);
}

void World::restore(const model::State& state) { ode::restore(bodies_, state); }

void World::launch(const model::Event& event) {
  const dBodyID body = bodies_[event.body];
  if (event.pose) place(body, *event.pose);
  set_velocity(body, event.velocity, event.angular_velocity);
}

void World::drive(int joint, int axis, const model::AxisMotor& motor) {
  ode::set_motor(joints_[joint], model_->joints[joint].kind, axis, motor);
}

void World::limit(int joint, const model::AxisLimit& limit) {
  set_limit(joints_[joint], model_->joints[joint].kind, 0, limit);
}

double World::coordinate(int joint, int axis) {
  return ode::coordinate(joints_[joint], model_->joints[joint].kind, axis);
}

int World::count_rows(int joint) { return ode::count_rows(joints_[joint], model_->joints[joint].kind); }

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
    set_velocity(bodies_[body], model::Vec3::Zero(), model::Vec3::Zero());
    dBodyDisable(bodies_[body]);
  }
}

void World::store(std::span<const int>, model::State& state) const { copy_out(bodies_, state); }

void World::set_velocities(std::span<const int> bodies, const model::State& state) {
  for (const int body : bodies)
    set_velocity(bodies_[body], state.velocity[body], state.angular_velocity[body]);
}

void World::advance(int num_steps, core::LapTimer& timer) {
  for (int i = 0; i < num_steps; ++i) {
    log_->set_place(id_, step_);
    take_step(i + 1 == num_steps, timer);
  }
}

void World::take_step(bool is_last, core::LapTimer& timer) {
  rules_.begin_step(*this, step_);
  if (rules_.all_asleep()) return sleep_on(is_last);
  moved_ = true;
  aim_held();
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
    count();
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

void World::forget_contacts() {
  contacts_.forget();
  shown_.contacts.clear();
}

int World::sweeps_of(int body) const {
  if (!stepping::traits_of(settings_.kind).iterates) return 1;
  return rules_.field() != nullptr ? rules_.field()->iterations_of(body) : settings_.iterations;
}

void World::collide() {
  const core::PhaseMark mark(core::PhaseMark::MarkedPhase::collision);
  const std::vector<GeomPair>& pairs = broad_phase_->find_pairs();
  do {
    contacts_.clear();
    contacts_.make(world_.get(), awake_pairs(pairs), broad_phase_->geoms());
  } while (rules_.after_collision(*this));
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

}  // namespace pbmpi::ode
