/// Which islands of a world sleep, as one rank knows it: of its own world, or of one cut into spaces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "effects/sleepers.h"
#include "model/contact.h"

namespace pbmpi::effects {

/// Sleepers with the state that they are about. Where ranks share a world, every rank knows of every body
/// whether it sleeps, and with whom: what falls asleep or wakes is agreed on each step. How long an awake
/// body has rested only its owner knows.
class SpaceSleepers {
 public:
  /// Borrows both; `state` is the rank's copy; in a shared world only its own rows are current.
  SpaceSleepers(const model::Model& model, double dt_s, model::State& state)
      : sleepers_(model, dt_s), state_(&state) {}

  /// The state is another from now on.
  void start();
  /// Takes in rest_rows().
  void put(std::span<const int> bodies, std::span<const double> rows);
  /// State::rest of these bodies, [bodies][8]: position, orientation (w, x, y, z), idle_steps.
  std::vector<double> rest_rows(std::span<const int> bodies) const;

  bool asleep(int body) const { return state_->rest[body].asleep(); }
  int island(int body) const { return state_->rest[body].island(); }  ///< of one that sleeps
  bool all_asleep() const { return sleepers_.awake().empty(); }
  std::span<const int> awake() const { return sleepers_.awake(); }
  /// Rises whenever a body wakes or falls asleep.
  long revision() const { return revision_; }

  /// Wakes what the events of this step concern: the same on every rank.
  void wake_called(std::int64_t step) { wake(sleepers_.islands_called(step, *state_)); }
  std::vector<int> islands_touched(std::span<const model::Contact> contacts) const;
  /// Islands that sleep, ascending. True if there were any.
  bool wake(std::span<const int> islands);
  /// The islands of those of these bodies that sleep; any of them may be no_body. True if there were any.
  bool wake_islands_of(std::span<const int> bodies);

  /// At the end of a step: counts for those of these bodies that are awake, which make up whole islands but
  /// for contacts across spaces; returns those that may fall asleep.
  std::vector<Resting> find_resting(std::span<const int> bodies, std::span<const BodyPair> touching);
  void put_to_sleep(std::span<const Resting> resting);

 private:
  Sleepers sleepers_;
  model::State* state_;
  long revision_ = 0;
};

}  // namespace pbmpi::effects
