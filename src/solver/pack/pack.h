/// A pack: the worlds that are stepped together, so that their bodies, joints and contacts fill the lanes.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "effects/breakage.h"
#include "model/contact.h"
#include "model/model.h"
#include "model/state.h"
#include "solver/layout/packed_world.h"
#include "solver/layout/row_law.h"
#include "stepping/observables.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Uniform numbers of a step.
struct StepParameters {
  double dt_s = 0.01;
  int substeps = 1;
  int all_substeps = 1;  ///< of the run: an island may get fewer, and has the springs of all
  int iterations = 20;
  double sor_factor = 1.3;
  double warm_start = 0;  ///< share of the impulses that a step and a substep take over from the one before
  int relax = 0;          ///< sweeps at the end of a substep that push nothing out
  Spring contacts;
  Spring joint_places, joint_turns;  ///< of joints: where they hold their bodies, and how they turn them
  stepping::JointSolver joint_solver = stepping::JointSolver::sweeps;
  stepping::Friction friction = stepping::Friction::pyramid;
  bool pushes = true;      ///< false: contacts that carry force stay as deep, or as open, as they are
  bool newton = false;     ///< the sweeps of rigid rows are followed by Newton's method (newton/row_system.h)
  bool shuffled = true;    ///< false: the joints of an articulation and the contacts keep their order
  bool residuals = false;  ///< measure them at the end of the solve
  bool show_forces = false;     ///< hand out the forces with which the step ends, whatever the warm start
  std::uint64_t order_key = 0;  ///< (seed, step): the order of joints within an articulation, and of contacts

  double substep_s() const { return dt_s / substeps; }
};

/// One implementation for each number type, number of lanes and instruction set; all give the same bits for a
/// number type. Bodies of a world are those of its model.
class Pack {
 public:
  virtual ~Pack() = default;
  virtual void load(int world, const model::State& state) = 0;
  virtual void store(int world, model::State& state) const = 0;
  /// Loads or stores some bodies only: the rows of `state` that belong to them.
  virtual void load(int world, std::span<const int> bodies, const model::State& state) = 0;
  virtual void store(int world, std::span<const int> bodies, model::State& state) const = 0;
  /// From now on a step moves these bodies of this world and no others of it (at the start: all). Batches
  /// that hold none of them are passed over; a body that shares a batch with them may move, too, and is not
  /// to be looked at before its next load(), unless Passes::holds_bodies(): it is then put back. Bodies
  /// that joints connect are active together, and the two of a contact; step() passes over the contacts of
  /// others.
  virtual void set_active(int world, std::span<const int> bodies) = 0;
  /// With the pass "sleeping": from now on collide() looks for the contacts of which one of these bodies is
  /// one (at the start: all).
  virtual void set_awake(int world, std::span<const int> bodies) = 0;
  virtual void set_motor(int world, int joint, int axis, const model::AxisMotor& motor) = 0;
  virtual void set_limit(int world, int joint, int axis, const model::AxisLimit& limit) = 0;
  virtual void launch(int world, const model::Event& event) = 0;
  /// The joints of a body forget their forces: it was taken to where they say nothing.
  virtual void forget(int world, int body) = 0;
  /// Joints of a world are broken from now on (State::broken_in): they act no more, their settings change no
  /// more, their bodies may touch, and need not be active together. What is broken stays so.
  virtual void set_broken(int world, std::span<const std::int32_t> broken_in) = 0;
  /// [m] Centre of mass of a body, world frame.
  virtual model::Vec3 centre(int world, int body) const = 0;
  /// may_be_fast[num_worlds]: 0 if no geom of the world can be fast (effects/fast_bodies.h) in a step of
  /// `dt_s` from now. All 0 without the pass "fast_bodies".
  virtual void find_fast(double dt_s, std::vector<char>& may_be_fast) const = 0;
  /// may_be_slow[num_worlds]: 0 if the centre of each body of the world would move farther than `way_m` in a
  /// step of `dt_s` at its velocity of now.
  virtual void find_slow(double dt_s, double way_m, std::vector<char>& may_be_slow) const = 0;
  /// Poses of a world's bodies: [num_bodies].
  virtual void poses(int world, std::span<model::BodyPose> poses) const = 0;
  /// Collision detection among the swept geoms at the poses of now: the contacts of each world, in canonical
  /// order. Nothing without the pass "collision".
  virtual void collide(std::span<std::vector<model::Contact>> contacts) = 0;
  /// The contacts of given pairs (sorted) of one world, swept geoms or not; appended.
  virtual void collide_pairs(int world, std::span<const model::GeomPair> pairs,
                             std::vector<model::Contact>& contacts) = 0;
  using Contacts = std::span<const std::span<const model::Contact>>;
  using Forces = std::span<const std::span<model::ContactForce>>;
  /// One step with these contacts (of each world, in canonical order), and with the forces with which they
  /// start, and end after the call: [contacts] of each world, or none. Spans hold during the call.
  /// Adds the seconds spent on rows, solve and integrate to `times`.
  void step(Contacts contacts, Forces forces, const StepParameters& parameters, core::PhaseTimes& times) {
    begin_step(contacts, forces, parameters, times);
    finish_step(times);
  }
  /// A step in parts: all before the iterations of the last substep; then some of these iterations, at most
  /// as many as are left; then the rest of the step.
  virtual void begin_step(Contacts contacts, Forces forces, const StepParameters& parameters,
                          core::PhaseTimes& times) = 0;
  virtual void iterate(int iterations, core::PhaseTimes& times) = 0;
  virtual void finish_step(core::PhaseTimes& times) = 0;
  /// Before finish_step(): the states [num_worlds] as they would be if the step ended now. Costs an
  /// integration, and disturbs nothing.
  virtual void look(std::span<model::State> states) = 0;
  /// How far a world's last step was from the solution of its constraints; StepParameters::residuals only.
  virtual stepping::Residuals residuals(int world) const = 0;
  /// What a joint of an active body exerted in the last substep.
  virtual effects::Reaction reaction(int world, int joint) const = 0;
  /// Rows that a joint had in the last step in which it acted, limits and motors included.
  virtual int joint_rows(int world, int joint) const = 0;
};

}  // namespace pbmpi::solver
