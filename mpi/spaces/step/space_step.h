/// One step of one world over the ranks that own its spaces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.h"
#include "core/traffic.h"
#include "effects/sleepers.h"
#include "mpi/comm/agreement.h"
#include "mpi/comm/communicator.h"
#include "mpi/spaces/step/crossing_search.h"
#include "mpi/spaces/step/frame_report.h"
#include "mpi/spaces/step/island_dispatch.h"
#include "mpi/spaces/step/island_shipping.h"
#include "mpi/spaces/step/rank_islands.h"
#include "mpi/spaces/step/step_context.h"
#include "stepping/space_stepper.h"

namespace pbmpi::mpi {

/// With the effect "sleeping" every rank knows for every body whether it sleeps. The ranks agree after
/// collision on the islands that wake, and at the end of a step on those that fall asleep: one allgatherv for
/// each round of waking, one for the resting parts of islands, and one more where there are any. Where
/// nothing can cross each rank decides alone; a step in which all bodies sleep sends nothing.
///
/// Called by SpaceStep. Does nothing without the effect.
class SleepAgreement {
 public:
  /// Both are borrowed.
  SleepAgreement(StepContext& shared, CrossingSearch& crossing) : shared_(&shared), crossing_(&crossing) {}

  /// To be called after the events of the step, which may wake islands: do all bodies sleep through the step?
  /// Every rank gives the same answer, even one that holds an error: the exchange of messages depends on it.
  bool sleeps_through(std::int64_t step);
  /// After collision: wakes islands, and collides again, until no awake body touches a sleeping one, on this
  /// rank or across spaces. `contacts`: this rank's own.
  void wake_touched(std::int64_t step, std::vector<model::Contact>& contacts, core::LapTimer& timer);
  /// At the end of a step: puts an island to sleep once all its parts, on whatever ranks, have rested.
  void put_resting_to_sleep(std::int64_t step, core::LapTimer& timer);

 private:
  std::vector<effects::Resting> join(std::span<const effects::Resting> resting);

  StepContext* shared_;
  CrossingSearch* crossing_;
  std::vector<effects::BodyPair> touching_;  ///< in the step's own contacts, before islands are shipped
};

/// When the effect "field_of_interest" follows a body, the owner of that body sends its position to all other
/// ranks: one message of three numbers each a step. The rank that solves an island, which has all its bodies
/// and contacts, then decides whether the island is inside.
///
/// SpaceStep calls post() after the events of the step and take() after collision. Both do nothing without a
/// field or for a field that stands still; where all bodies are on one rank no message is sent.
class FieldCenter {
 public:
  /// `shared` is borrowed.
  explicit FieldCenter(StepContext& shared) : shared_(&shared) {}

  void post();
  void take(core::LapTimer& timer);

 private:
  /// Rank that owns the followed body; -1 if the field follows none.
  int owner() const;

  StepContext* shared_;
};

/// The phases of a step, each of which has a class of its own. All calls are collective; each runs one step.
/// On a single rank, and where nothing can cross (all bodies on one rank, or spaces that the scene says never
/// meet), a step sends no message and builds no island.
///
/// Otherwise every rank first handles events and collides in its own spaces. Root, which has what the
/// ranks sent at the end of the previous step, finds the contacts across spaces (before its
/// own collision if all of that has arrived by then) and tells the ranks whether there are any
/// (CrossingSearch). If so, each rank forms its islands from joints and own contacts (RankIslands) and
/// reports them; root joins them and orders the ranks which to ship, which to expect, and which contacts
/// across spaces to solve (IslandDispatch); islands are shipped, and shipped back when they are solved
/// (IslandShipping). Where nothing crosses, a rank waits only for root's verdict.
///
/// The effects "sleeping" (SleepAgreement) and "field_of_interest" (FieldCenter) add messages of their own.
/// With the effect "breakable_joints" the broken joints are sent with the states of their bodies, and the
/// forces that a step hands on to the next are sent with the states of the bodies on which they act. The last
/// step of a frame ends with an account to root (FrameReport).
///
/// Errors of the stepper are held in `errors`; the messages of the step are exchanged regardless.
class SpaceStep {
 public:
  /// All borrowed.
  SpaceStep(const Communicator& comm, stepping::SpaceStepper& stepper, ErrorHold& errors);
  SpaceStep(const SpaceStep&) = delete;
  SpaceStep& operator=(const SpaceStep&) = delete;

  /// Gives the spaces new owners from now on. `state`: of all bodies, on every rank.
  void own(const SpaceOwnership& ownership, const model::State& state, std::int64_t step);

  /// To be called before the first step of a frame.
  void start_frame() { report_.start_frame(); }
  /// `last`: the last step of a frame, after which root has all rows of the state, and findings().
  void run(std::int64_t step, bool last, core::PhaseTimes& times);

  // On root.
  const FrameFindings& findings() const { return report_.findings(); }
  std::span<const geometry::Box> boxes() const { return crossing_.boxes(); }  ///< [num_spaces]
  /// The contacts that this rank solved in the last step, in canonical order.
  std::span<const model::Contact> contacts() const { return work_.contacts; }
  core::Traffic take_traffic() { return shared_.mail ? shared_.mail->take_traffic() : core::Traffic{}; }

 private:
  void exchange(std::int64_t step, core::LapTimer& timer);
  void sleep_through(std::int64_t step, bool last, core::PhaseTimes& times);
  void report_frame(core::PhaseTimes& times);

  StepContext shared_;
  StepWork work_;
  RankIslands islands_{shared_};
  CrossingSearch crossing_{shared_};
  IslandDispatch dispatch_{shared_};
  IslandShipping shipping_{shared_};
  SleepAgreement sleep_{shared_, crossing_};
  FieldCenter center_{shared_};
  FrameReport report_{shared_, islands_, crossing_};
};

}  // namespace pbmpi::mpi
