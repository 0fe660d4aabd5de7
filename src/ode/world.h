/// One world in ODE.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ode/collide/broad_phase.h"
#include "ode/collide/contacts.h"
#include "ode/effects/focus.h"
#include "ode/effects/joint_loads.h"
#include "ode/objects/engine.h"
#include "ode/solver_resources.h"
#include "stepping/engine/jointed_world.h"

namespace pbmpi::ode {

/// ODE enables every body that a joint, contacts included, connects to an enabled one, so whole islands wake
/// before their contacts take part in a step. A broken joint keeps its place: attached anew, it would take
/// the pose of that moment as its zero. The poses of `state_` are those that the rules have stored.
///
/// The collision spaces of the model cut one world over ranks; here the world is whole, and all its geoms
/// are in one ODE space.
class World final : public stepping::JointedWorld {
 public:
  /// `model`, `targets` and `log` are borrowed; `state`: at the start of step `step`.
  World(int id, const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
        std::int64_t step, const stepping::StepperSettings& settings, const SolverResources& resources,
        MessageLog& log);

  void advance(int num_steps, core::LapTimer& timer) override;
  std::optional<stepping::StepProfile> profile_last_step() override;

 private:
  void restore(const model::State& state) override;
  void launch(const model::Event& event) override;
  void drive(int joint, int axis, const model::AxisMotor& motor) override;
  void limit(int joint, const model::AxisLimit& limit) override;
  double coordinate(int joint, int axis) override;
  int count_rows(int joint) override;
  const std::vector<stepping::Touch>& touches() const override { return contacts_.touches(); }
  double deepest_m() const override { return contacts_.deepest_m(); }
  void forget_contacts() override;
  model::Vec3 centre(int body) const override { return vec3(dBodyGetPosition(bodies_[body])); }
  Velocities velocities(int body) const override {
    return {vec3(dBodyGetLinearVel(bodies_[body])), vec3(dBodyGetAngularVel(bodies_[body]))};
  }
  void make_ahead(const std::vector<model::Contact>& contacts) override {
    contacts_.make_ahead(world_.get(), contacts, settings_.dt_s);
  }
  void append_contacts(std::span<const model::Vec3> before,
                       std::vector<model::LoadedContact>& contacts) const override {
    contacts_.show(before, contacts);
  }
  model::JointForce joint_force(int joint) const override { return loads_.force(joint); }
  void store(std::span<const int> bodies, model::State& state) const override;
  void set_velocities(std::span<const int> bodies, const model::State& state) override;
  effects::Reaction reaction(int joint) const override { return loads_.reaction(joint); }
  void show_awake() override;
  void show_asleep(std::span<const int> bodies) override;
  void show_broken() override;

  void take_step(bool is_last, core::LapTimer& timer);
  /// Sweeps over the rows of the island that contains this body, in the present step.
  int sweeps_of(int body) const;
  void collide();
  void set_broken(const std::vector<std::int32_t>& broken_in);
  void solve();
  void solve_enabled(int iterations);
  void profile_collision(stepping::StepProfile& profile);
  void profile_islands(stepping::StepProfile& profile);
  double time_solve(const std::vector<dBodyID>& enabled, int iterations, const model::State& before);

  int id_;
  MessageLog* log_;
  WorldHandle world_;
  std::vector<dBodyID> bodies_;
  std::vector<dJointID> joints_;
  JointLoads loads_;
  Contacts contacts_;
  std::optional<BroadPhase> broad_phase_;  ///< none without the effect "collision"
  std::optional<Focus> focus_;             ///< none without this pass
  model::State before_last_;  ///< with `profile`: before the last step's collision detection, events done
};

}  // namespace pbmpi::ode
