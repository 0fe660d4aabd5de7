/// One world in Bullet.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "bullet/collide/contacts.h"
#include "bullet/collide/island_world.h"
#include "bullet/collide/pairs.h"
#include "bullet/objects/joint_loads.h"
#include "stepping/engine/jointed_world.h"

namespace pbmpi::bullet {

/// The poses of `state_` are those that the rules have stored.
class World final : public stepping::JointedWorld {
 public:
  /// `model`, `targets` and `collider` are borrowed; `state`: at the start of step `step`.
  World(const model::Model& model, stepping::MotorTargets& targets, const model::State& state,
        std::int64_t step, const stepping::StepperSettings& settings, Collider& collider);

  void advance(int num_steps, core::LapTimer& timer) override;

 private:
  void restore(const model::State& state) override { bodies_.restore(state); }
  void launch(const model::Event& event) override;
  void drive(int joint, int axis, const model::AxisMotor& motor) override;
  void limit(int joint, const model::AxisLimit& limit) override { joints_.set_limit(joint, 0, limit); }
  double coordinate(int joint, int axis) override { return joints_.coordinate(joint, axis); }
  int count_rows(int joint) override { return joints_.count_rows(joint); }
  const std::vector<stepping::Touch>& touches() const override { return contacts_.touches(); }
  double deepest_m() const override { return contacts_.deepest_m(); }
  void forget_contacts() override;
  model::Vec3 centre(int body) const override { return vec3(bodies_[body].getCenterOfMassPosition()); }
  Velocities velocities(int body) const override {
    return {vec3(bodies_[body].getLinearVelocity()), vec3(bodies_[body].getAngularVelocity())};
  }
  void make_ahead(const std::vector<model::Contact>& contacts) override { contacts_.make_ahead(contacts); }
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

  bool take_step(bool is_last, core::LapTimer& timer);
  void collide();
  void settle();
  bool is_finite() const;

  Bodies bodies_;
  AxisJoints joints_;
  JointLoads loads_;
  btSimpleBroadphase no_pairs_;  ///< Bullet's world requires it, but never runs it
  IslandWorld world_;
  Shapes shapes_;
  Pairs pairs_;
  Contacts contacts_;
  double linear_keep_, angular_keep_;  ///< factors that a step's damping applies to the velocities
};

}  // namespace pbmpi::bullet
