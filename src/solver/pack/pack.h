/// A pack: worlds that are stepped together, so that their bodies, joints and contacts fill the lanes.
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
#include "solver/contacts/renewed_contacts.h"
#include "solver/layout/packed_world.h"
#include "solver/layout/row_law.h"
#include "stepping/observables.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// The parameters of a step, the same in all lanes.
struct StepParameters {
  double dt_s = 0.01;
  int substeps = 1;
  int all_substeps = 1;  ///< of the run: an island may get fewer substeps, and has the springs of all
  int iterations = 20;
  double sor_factor = 1.3;
  double warm_start = 0;  ///< share of the last step's or substep's impulses that is taken over
  int relax = 0;          ///< sweeps at the end of a substep that correct no position error
  Spring contacts;
  Spring joint_places, joint_turns;  ///< of joints: for rows that hold a place, and an orientation
  stepping::JointSolver joint_solver = stepping::JointSolver::sweeps;
  stepping::Friction friction = stepping::Friction::pyramid;
  bool pushes = true;           ///< false: contacts that carry force keep their depth or gap
  bool newton = false;          ///< Newton's method follows the sweeps of rigid rows (newton/row_system.h)
  bool shuffled = true;         ///< false: an articulation's joints and the contacts keep their order
  bool residuals = false;       ///< measure them at the end of the solve
  bool show_forces = false;     ///< return the forces with which the step ends, whatever the warm start
  std::uint64_t order_key = 0;  ///< from (seed, step): the order of an articulation's joints, and of contacts

  double substep_s() const { return dt_s / substeps; }
};

/// There is one implementation for each number type, number of lanes and instruction set; all give the same
/// bits for a number type. Bodies of a world are indexed as in its model.
class Pack {
 public:
  virtual ~Pack() = default;
  virtual void load(int world, const model::State& state) = 0;
  virtual void store(int world, model::State& state) const = 0;
  /// Loads or stores some bodies only: the rows of `state` that belong to them.
  virtual void load(int world, std::span<const int> bodies, const model::State& state) = 0;
  virtual void store(int world, std::span<const int> bodies, model::State& state) const = 0;
  /// From now on a step moves exactly these bodies of this world (at the start: all). Batches without any of
  /// them are skipped; another body in a batch with them may move too, and its state is invalid until its
  /// next load(), unless Passes::holds_bodies(): it is then put back. Bodies that joints connect are active
  /// together, and so are the two of a contact; step() skips the contacts of inactive bodies.
  virtual void set_active(int world, std::span<const int> bodies) = 0;
  /// With the pass "sleeping": from now on collide() looks for the contacts that have one of these bodies (at
  /// the start: all).
  virtual void set_awake(int world, std::span<const int> bodies) = 0;
  virtual void set_motor(int world, int joint, int axis, const model::AxisMotor& motor) = 0;
  virtual void set_limit(int world, int joint, int axis, const model::AxisLimit& limit) = 0;
  virtual void launch(int world, const model::Event& event) = 0;
  /// See WorldStepper::set_load().
  virtual void set_load(int world, int body, const stepping::BodyLoad& load) = 0;
  /// Makes the joints of a body forget their forces, because it was put where they no longer apply.
  virtual void forget(int world, int body) = 0;
  /// Takes in which joints of a world are broken from now on (State::broken_in): they no longer act, their
  /// settings no longer change, and their bodies may touch and need not be active together. A broken joint
  /// stays broken.
  virtual void set_broken(int world, std::span<const std::int32_t> broken_in) = 0;
  /// [m] Centre of mass of a body, world frame.
  virtual model::Vec3 centre(int world, int body) const = 0;
  /// may_be_fast[num_worlds]: 0 if no geom of the world can be fast or approach others
  /// (effects/fast_bodies.h) in a step of `dt_s` from now. All 0 without the pass "fast_bodies".
  virtual void find_fast(double dt_s, std::vector<char>& may_be_fast) const = 0;
  /// may_be_slow[num_worlds]: 0 if the centre of each body of the world would move farther than `way_m` in a
  /// step of `dt_s` at its current velocity.
  virtual void find_slow(double dt_s, double way_m, std::vector<char>& may_be_slow) const = 0;
  /// Poses of a world's bodies: [num_bodies].
  virtual void poses(int world, std::span<model::BodyPose> poses) const = 0;
  /// Collision detection among the swept geoms at the current poses: the contacts of each world, in canonical
  /// order. Does nothing without the pass "collision".
  virtual void collide(std::span<std::vector<model::Contact>> contacts) = 0;
  /// Appends the contacts of given pairs (sorted) of one world, whether or not their geoms are swept.
  virtual void collide_pairs(int world, std::span<const model::GeomPair> pairs,
                             std::vector<model::Contact>& contacts) = 0;
  using Contacts = std::span<const model::SolvedContacts>;
  /// Takes one step with the contacts of each world, which must stay valid during the call. Adds the seconds
  /// spent on rows, solve and integrate to `times`. `renewed`: null, or islands of active bodies that get
  /// contacts anew in the step, none of which are in `contacts`.
  virtual void step(Contacts contacts, const StepParameters& parameters, RenewedContacts* renewed,
                    core::PhaseTimes& times) = 0;
  /// How far a world's last step was from the solution of its constraints; StepParameters::residuals only.
  virtual stepping::Residuals residuals(int world) const = 0;
  /// What a joint of an active body exerted in the last substep.
  virtual effects::Reaction reaction(int world, int joint) const = 0;
  /// Rows that a joint had in the last step in which it acted, limits and motors included.
  virtual int joint_rows(int world, int joint) const = 0;
};

}  // namespace pbmpi::solver
