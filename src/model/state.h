/// The moving part of a world: what is hashed, sent, recorded and restored.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/model.h"
#include "model/step_memory.h"

namespace pbmpi::model {

/// What tells a motion of a body from its trembling, on one scale of time (effects/sleepers.h).
struct MotionWatch {
  std::int32_t steps = 0;       ///< taken since the watch began, as far as the rule counts them
  std::array<Pose, 2> knots{};  ///< where the body was at the ends of the last two intervals
  /// Mean squares of what a step of this scale changes: of the velocity [m^2/s^2] and of the angular velocity
  /// [rad^2/s^2].
  double tremble = 0, angular_tremble = 0;
};

/// How long a body has rested.
struct Rest {
  Vec3 position = Vec3::Zero();  ///< the pose near which it has stayed [m], world frame
  Quat orientation;
  /// Steps for which it has stayed there, up to what the rule asks for. For a sleeping body: -1 - the lowest
  /// body of its island.
  std::int32_t idle_steps = 0;
  Vec3 velocity = Vec3::Zero();          ///< after the last step [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< [rad/s]
  std::array<MotionWatch, 2> watches{};  ///< over parts of the rule's time, and over four times it

  bool asleep() const { return idle_steps < 0; }
  int island() const { return -1 - idle_steps; }  ///< of a sleeping body: the island's lowest body
  void sleep_in(int island) { idle_steps = -1 - island; }
};

/// Stands for the step in which a joint broke, for a joint that has not.
inline constexpr std::int32_t unbroken = -1;

/// What the guards of a run remember of a world (stability/guards.h). It travels with the state, so that the
/// guards see the same on any number of ranks.
struct GuardMemory {
  double energy_gain_j = 0;      ///< gain since the lowest energy, beyond what has a cause [J]
  double largest_kinetic_j = 0;  ///< largest kinetic energy of any frame so far [J]
  std::int32_t frozen_in = -1;   ///< the step from which on the world stands still; -1: it moves
};

/// One row a body, contiguous, world frame. state_parts.h lists what it consists of.
struct State {
  std::vector<Vec3> position;          ///< [num_bodies][3] m, centres of mass
  std::vector<Quat> orientation;       ///< [num_bodies][4] (w, x, y, z)
  std::vector<Vec3> velocity;          ///< [num_bodies][3] m/s
  std::vector<Vec3> angular_velocity;  ///< [num_bodies][3] rad/s
  std::vector<Rest> rest;              ///< [num_bodies]; empty without the effect "sleeping"
  /// [num_joints] the step in which each joint broke, or unbroken; empty without the effect
  /// "breakable_joints". A broken joint stays broken, even where the effect is left out.
  std::vector<std::int32_t> broken_in;
  StepMemory memory;  ///< kept by `sor` with its soft law
  GuardMemory guard;

  int num_bodies() const { return static_cast<int>(position.size()); }
  void resize(int num_bodies);
  /// The frame of a body; for no_body the world's.
  Pose pose(int body) const { return body == no_body ? Pose{} : Pose{position[body], orientation[body]}; }
  bool is_broken(std::size_t joint) const { return !broken_in.empty() && broken_in[joint] != unbroken; }
  /// Did the joint act in step `step`, given that this is the state after that step?
  bool acted_in(std::int64_t step, std::size_t joint) const {
    return !is_broken(joint) || broken_in[joint] >= step;
  }
};

/// Copies the pose and velocities of one body between two states of one model.
void copy_body(int body, const State& from, State& to);

/// What State::rest holds of a body that begins to rest where it is now.
Rest begin_rest(const State& state, int body);

/// The state in which `model` starts.
State initial_state(const Model& model);

/// Hash of all bits of poses and velocities, body by body, of the broken joints with their steps, of the
/// memory, and of the step from which on a world stands still. Equal states have equal hashes on every
/// machine.
std::uint64_t hash(const State& state);

/// How many bodies have a number that is NaN or infinite.
int count_nonfinite(const State& state);

/// Drops all remembered forces on a body, e.g. because it has been put elsewhere: its contacts, and the
/// forces of its joints.
void forget(const Model& model, int body, StepMemory& memory);

}  // namespace pbmpi::model
