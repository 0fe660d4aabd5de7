/// Which islands of a world sleep, as one rank knows it: of its own world, or of one cut into spaces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "effects/sleepers.h"
#include "model/contact.h"

namespace pbmpi::effects {

/// Sleepers together with the state that they act on. Where ranks share a world, every rank knows which
/// bodies sleep and with which island: the ranks agree each step on what falls asleep or wakes. How long an
/// awake body has rested is known to its owner alone.
class SpaceSleepers {
 public:
  /// Borrows both; `state` is the rank's copy; in a shared world only its own rows are current.
  SpaceSleepers(const model::Model& model, double dt_s, model::State& state)
      : sleepers_(model, dt_s), state_(&state) {}

  /// Takes in a new state.
  void start();
  /// Takes in rest_rows().
  void put(std::span<const int> bodies, std::span<const double> rows);
  /// State::rest of these bodies, a row each (model/state_parts.h).
  std::vector<double> rest_rows(std::span<const int> bodies) const;

  bool asleep(int body) const { return state_->rest[body].asleep(); }
  int island(int body) const { return state_->rest[body].island(); }  ///< of a sleeping body
  bool all_asleep() const { return sleepers_.awake().empty(); }
  std::span<const int> awake() const { return sleepers_.awake(); }
  /// Rises whenever a body wakes or falls asleep.
  long revision() const { return revision_; }

  /// Wakes the islands that the events of this step concern: the same on every rank.
  void wake_called(std::int64_t step) { wake(sleepers_.islands_called(step, *state_)); }
  std::vector<int> islands_touched(std::span<const model::Contact> contacts) const;
  /// Wakes these sleeping islands, given in ascending order. True if there were any.
  bool wake(std::span<const int> islands);
  /// Wakes the islands of the sleeping bodies among these, of which any may be no_body. True if there were
  /// any.
  bool wake_islands_of(std::span<const int> bodies);

  /// At the end of a step: counts the rest of the awake bodies among these, which make up whole islands
  /// except for contacts across spaces; returns those that rest, for Sleepers::join().
  std::vector<Resting> find_resting(std::span<const int> bodies, std::span<const BodyPair> touching,
                                    const Sleepers::IsDriven& is_driven);
  void put_to_sleep(std::span<const Resting> resting);

 private:
  Sleepers sleepers_;
  model::State* state_;
  long revision_ = 0;
};

}  // namespace pbmpi::effects
