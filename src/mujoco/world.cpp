#include "mujoco/world.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.h"
#include "core/marks.h"
#include "mujoco/mujoco_stepper.h"
#include "mujoco/observed.h"
#include "mujoco/parts.h"

namespace pbmpi::mujoco {
namespace {

/// Contacts for which there is room at first; more room is made when needed.
int first_contacts(const model::Model& model) { return 64 + 4 * static_cast<int>(model.geoms.size()); }

stepping::StepperSettings part_of(stepping::StepperSettings settings, int num_parts) {
  settings.dt_s /= num_parts;
  return settings;
}

void require_no_refusal(const model::Model& model) {
  const std::vector<std::string> reasons = refusals(model);
  core::require_input(reasons.empty(), "mujoco: " + (reasons.empty() ? "" : reasons.front()) +
                                           "; use another stepper, or change the scene");
}

}  // namespace

World::World(const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
             std::int64_t step, const stepping::StepperSettings& settings)
    : EngineWorld(model, targets, state, step, settings, std::nullopt),
      num_parts_(fewest_parts(settings.dt_s)),
      part_settings_(part_of(settings, num_parts_)),
      drives_(model, step),
      measures_loads_(settings.contacts || std::ranges::any_of(model.joints, &model::Joint::breakable)),
      kept_linear_(std::exp(-model.linear_damping * settings.dt_s)),
      kept_angular_(std::exp(-model.angular_damping * settings.dt_s)) {
  require_no_refusal(model);
  for (const stepping::MotorTargets::Target& target : targets_->all())
    drives_.set_motor(target.joint, target.axis, target.motor);
  after_.resize(model.num_bodies());
  set_state(state);
}

/// Collides once, so that a world that is too large is refused before its first step.
void World::set_state(const model::State& state) {
  state_ = state;
  state_.rest.clear();
  state_.memory.clear();
  rules_.start();
  is_lost_ = model::count_nonfinite(state_) > 0;
  if (compiled_ && compiled_->broken_in != state_.broken_in) compiled_.reset();
  if (is_lost_ || compiled_) return;
  compile();
  compiled_->at.to_mujoco(state_, compiled_->engine.data());
  collide();
}

void World::compile() {
  const bool has_friction = plan_.has(effects::EffectId::friction);
  compiled_ = std::make_unique<Compiled>(*model_, state_.broken_in, part_settings_, has_friction);
  compiled_->engine.make_room(first_contacts(*model_), compiled_->rows_without_contacts());
  drives_.show(compiled_->links, compiled_->at, compiled_->constraints, compiled_->engine.model());
}

void World::aim(const stepping::MotorTargets::Target& target) {
  drives_.set_motor(target.joint, target.axis, target.motor);
  if (compiled_)
    drives_.show(compiled_->links, compiled_->at, compiled_->constraints, compiled_->engine.model());
}

void World::fire_events(std::int64_t step) {
  auto next = std::ranges::lower_bound(model_->events, step, {}, &model::Event::step);
  for (; next != model_->events.end() && next->step == step; ++next) {
    const model::Event& event = *next;
    if (event.kind != model::EventKind::launch) continue;
    if (event.pose) {
      state_.position[event.body] = event.pose->position;
      state_.orientation[event.body] =
          model::Quat::from_eigen(event.pose->orientation.to_eigen().normalized());
    }
    state_.velocity[event.body] = event.velocity;
    state_.angular_velocity[event.body] = event.angular_velocity;
  }
  if (drives_.fire(step) && compiled_)
    drives_.show(compiled_->links, compiled_->at, compiled_->constraints, compiled_->engine.model());
  targets_->pass(*model_, step);
}

void World::store(std::span<const int>, model::State& state) const {
  for (int body = 0; body < model_->num_bodies(); ++body) model::copy_body(body, state_, state);
}

void World::set_velocities(std::span<const int> bodies, const model::State& state) {
  for (const int body : bodies) {
    state_.velocity[body] = state.velocity[body];
    state_.angular_velocity[body] = state.angular_velocity[body];
  }
}

void World::advance(int num_steps, core::LapTimer& timer) {
  for (int i = 0; i < num_steps && !is_lost_; ++i) take_step(i + 1 == num_steps, timer);
}

/// Takes more and shorter parts until nothing turns far within one: the number of parts depends only on the
/// state at the step's start.
void World::take_step(bool is_last, core::LapTimer& timer) {
  rules_.begin_step(*this, step_);
  if (!compiled_) compile();
  const int most_parts = most_halves * num_parts_;
  int parts = num_parts_;
  while (parts < most_parts && !turns_little(*model_, compiled_->links, state_, settings_.dt_s / parts))
    parts *= 2;
  for (;; parts *= 2) {
    const bool finite = solve_step(parts, is_last, timer);
    if (finite) compiled_->at.to_state(compiled_->engine.model(), compiled_->engine.data(), after_);
    if (finite &&
        (turns_little(*model_, compiled_->links, after_, settings_.dt_s / parts) || parts >= most_parts))
      break;
    if (parts >= most_parts) return lose();
  }
  take_in_solution();
  timer.lap(core::Phase::integrate);
  if (is_lost_) return;
  rules_.after_solve(*this, step_);
  ++step_;
}

/// Does all of the step except storing its results in the state. If the stack was too small, it is enlarged
/// and the step begun anew; false as from solve_part().
bool World::solve_step(int parts, bool is_last, core::LapTimer& timer) {
  set_part(*compiled_, *model_, settings_.dt_s / parts);
  for (;;) {
    try {
      return solve_parts(parts, is_last, timer);
    } catch (const EngineError& error) {
      if (!is_stack_overflow(error)) throw;
      compiled_->engine.make_stack();
    }
  }
}

bool World::solve_parts(int parts, bool is_last, core::LapTimer& timer) {
  shown_.clear();
  mjData& data = compiled_->engine.data();
  data.warning[mjWARN_BADQACC].number = 0;
  compiled_->at.to_mujoco(state_, data);
  for (int part = 0; part < parts; ++part) {
    if (!solve_part(is_last && part + 1 == parts, timer)) return false;
  }
  if (measures_loads_) compiled_->loads.measure(compiled_->engine.model(), compiled_->engine.data());
  if (is_last && settings_.contacts) show_contacts();
  timer.lap(core::Phase::islands);
  return true;
}

/// False if MuJoCo gave the world up: it resets its data where an acceleration is not finite or above 1e10,
/// and counts that.
bool World::solve_part(bool is_last, core::LapTimer& timer) {
  collide();
  timer.lap(core::Phase::collide);
  solve();
  timer.lap(core::Phase::solve);
  const mjData& data = compiled_->engine.data();
  if (data.warning[mjWARN_BADQACC].number > 0) return false;
  if (is_last)
    count(*model_, state_, compiled_->at, compiled_->touches, compiled_->engine.model(), data, counts_);
  timer.lap(core::Phase::islands);
  return true;
}

/// Repeats until there is room for all contacts, and for all rows that they can have. mj_kinematics()
/// normalises quaternions in qpos; doing it twice is not the same as once, so each try starts from the same
/// qpos.
void World::collide() {
  const core::PhaseMark mark(core::PhaseMark::MarkedPhase::collision);
  Engine& engine = compiled_->engine;
  const mjModel& compiled = engine.model();
  qpos_.assign(engine.data().qpos, engine.data().qpos + compiled.nq);
  for (;;) {
    mjData& data = engine.data();
    std::ranges::copy(qpos_, data.qpos);
    mj_kinematics(&compiled, &data);
    mj_comPos(&compiled, &data);
    mj_crb(&compiled, &data);
    mj_factorM(&compiled, &data);
    mj_collision(&compiled, &data);
    if (data.warning[mjWARN_CONTACTFULL].number > 0) {
      engine.make_room(2 * compiled.nconmax, compiled.njmax);
      continue;
    }
    compiled_->touches.apply(data);
    const int rows = compiled_->rows_without_contacts() + Touches::count_rows(data);
    if (rows <= compiled.njmax) return;
    const int roomy = rows + rows / 4;
    engine.make_room(compiled.nconmax, engine.fits(compiled.nconmax, roomy) ? roomy : rows);
  }
}

/// Does the rest of mj_step1(), and mj_step2(), which integrates.
void World::solve() {
  const core::PhaseMark mark(core::PhaseMark::MarkedPhase::forward_step);
  const mjModel& compiled = compiled_->engine.model();
  mjData& data = compiled_->engine.data();
  mj_makeConstraint(&compiled, &data);
  mj_projectConstraint(&compiled, &data);
  mj_fwdVelocity(&compiled, &data);
  drives_.aim(compiled_->links, compiled_->at, compiled, data);
  mj_step2(&compiled, &data);
}

/// Shows the contacts of the last part: MuJoCo's poses are still those at its start.
void World::show_contacts() {
  const mjData& data = compiled_->engine.data();
  std::vector<model::Vec3> centres;
  centres.reserve(model_->bodies.size());
  for (int body = 0; body < model_->num_bodies(); ++body)
    centres.emplace_back(data.xpos + 3 * compiled_->at.body_id(body));
  compiled_->touches.show(compiled_->engine.model(), data, centres, shown_);
  for (int joint = 0; joint < model_->num_joints(); ++joint)
    shown_.joints.push_back(compiled_->loads.force(joint));
}

void World::take_in_solution() {
  if (model::count_nonfinite(after_) > 0) return lose();
  for (int body = 0; body < model_->num_bodies(); ++body) {
    model::copy_body(body, after_, state_);
    if (kept_linear_ != 1) state_.velocity[body] *= kept_linear_;
    if (kept_angular_ != 1) state_.angular_velocity[body] *= kept_angular_;
  }
}

/// The poses stay at their last values, so that they can be drawn.
void World::lose() {
  is_lost_ = true;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (model::Vec3& velocity : state_.velocity) velocity.setConstant(nan);
  for (model::Vec3& velocity : state_.angular_velocity) velocity.setConstant(nan);
}

void World::read(model::State& state, stepping::Observables& observables) {
  const model::GuardMemory guard = state.guard;
  state = state_;
  state.guard = guard;
  observables = counts_;
  observer_.observe(state, observables);
}

}  // namespace pbmpi::mujoco
