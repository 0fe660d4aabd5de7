#include "bullet/world.h"

#include <algorithm>
#include <cmath>

#include "core/marks.h"

namespace pbmpi::bullet {
World::World(const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
             std::int64_t step, const stepping::StepperSettings& settings, Collider& collider)
    : JointedWorld(model, targets, state, step, settings, std::nullopt),
      bodies_(model),
      joints_(model, bodies_),
      loads_(model, bodies_, joints_, measured_joints()),
      no_pairs_(model.num_bodies() + 1),
      world_(model, bodies_, joints_, collider, no_pairs_),
      shapes_(model, bodies_),
      pairs_(model, shapes_),
      contacts_(model, plan_, shapes_, bodies_, collider, world_.collision_info(), settings.dt_s),
      linear_keep_(std::exp(-model.linear_damping * settings.dt_s)),
      angular_keep_(std::exp(-model.angular_damping * settings.dt_s)) {
  start(state);
}

void World::launch(const model::Event& event) {
  if (event.pose) bodies_.place(event.body, event.pose->position, event.pose->orientation);
  bodies_.set_velocity(event.body, event.velocity, event.angular_velocity);
}

void World::drive(int joint, int axis, const model::AxisMotor& motor) {
  joints_.set_motor(joint, axis, motor);
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

/// Stops as soon as a body has a non-finite number.
void World::advance(int num_steps, core::LapTimer& timer) {
  for (int i = 0; i < num_steps && !is_lost_; ++i)
    is_lost_ = !is_finite() || !take_step(i + 1 == num_steps, timer);
}

/// False if a body has a non-finite number after it.
bool World::take_step(bool is_last, core::LapTimer& timer) {
  rules_.begin_step(*this, step_);
  if (rules_.all_asleep()) {
    sleep_on(is_last);
    return true;
  }
  moved_ = true;
  joints_.follow();
  aim_held();
  if (is_last && settings_.contacts) note_centres();
  if (plan_.has(effects::EffectId::collision)) {
    collide();
    timer.lap(core::Phase::collide);
  }
  if (is_last) {
    count();
    counts_.row_visits = static_cast<double>(counts_.rows) * settings_.iterations;
  }
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

void World::forget_contacts() {
  contacts_.forget();
  shown_.clear();
}

void World::collide() {
  const core::PhaseMark mark(core::PhaseMark::MarkedPhase::collision);
  shapes_.move();
  const std::vector<model::GeomPair>& pairs = pairs_.find();
  do {
    contacts_.make(awake_pairs(pairs));
  } while (rules_.after_collision(*this));
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

}  // namespace pbmpi::bullet
