/// Makes the ranks agree on which islands wake and fall asleep.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.h"
#include "effects/sleepers.h"
#include "mpi/spaces/step/crossing_search.h"
#include "mpi/spaces/step/step_context.h"

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

}  // namespace pbmpi::mpi
