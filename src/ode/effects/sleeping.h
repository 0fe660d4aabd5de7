/// The effect "sleeping" in one ODE world.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "effects/sleepers.h"
#include "ode/collide/contacts.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// ODE's own auto-disable is off: what sleeps follows from State::rest by the rule of all steppers
/// (effects::Sleepers), and bodies are disabled accordingly. As ODE enables what is connected to an enabled
/// body by a joint, contacts included, the rule wakes whole islands before the contacts are made.
class Sleeping {
 public:
  /// `model` is borrowed.
  Sleeping(const model::Model& model, double dt_s, const std::vector<dBodyID>& bodies);

  /// The world stands in this state from now on.
  void start(const model::State& state);
  /// Joints are broken from now on: as in model::State.
  void set_broken(const std::vector<std::int32_t>& broken_in) { state_.broken_in = broken_in; }
  bool all_asleep() const { return sleepers_.awake().empty(); }
  std::span<const int> awake() const { return sleepers_.awake(); }  ///< bodies, ascending
  const std::vector<model::Rest>& rest() const { return state_.rest; }

  /// Wakes what the events of this step concern.
  void wake_called(std::int64_t step);
  /// The pairs of which a geom is awake.
  const std::vector<GeomPair>& awake_pairs(const std::vector<GeomPair>& pairs);
  /// Wakes what is touched; true if it lay asleep, so that its own contacts are still to be found.
  bool wake_touched(const std::vector<Touch>& touches);
  /// After a step with these contacts: lets islands fall asleep.
  void settle(const std::vector<Touch>& touches);

 private:
  bool wake(const std::vector<int>& islands);
  void disable_sleepers();
  void take(const std::vector<Touch>& touches);

  const model::Model* model_;
  std::vector<dBodyID> bodies_;
  effects::Sleepers sleepers_;
  model::State state_;
  std::vector<GeomPair> pairs_;
  std::vector<effects::BodyPair> touching_;
};

}  // namespace pbmpi::ode
