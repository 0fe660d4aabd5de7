/// The effect breakable_joints: joints give way under load, or are released by an event.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "model/state.h"

namespace pbmpi::effects {

/// What a joint exerts on its bodies in a step, with opposite signs on the two: the magnitudes of ODE's
/// feedback f1, t1 on the first body (ODE manual, "Joint feedback"). With sor these are the impulses of the
/// joint's rows over the length of the (last) substep. Rows of limits and motors count, except for a motor
/// pressed against its limit, which pushes from outside the joint, as in ODE.
///
/// The torque is taken about the first body's anchor, t1 - r x f1 with r from its centre of mass to the
/// anchor (for a fixed joint, as the body stands after the step); a slider's is about the midpoint of the two
/// centres of mass, or, for a slider to the world, about the first body's.
struct Reaction {
  double force_n = 0;    ///< [N]
  double torque_nm = 0;  ///< [N m]
};

/// Where a fixed joint holds the second body's centre of mass, [m] in the first's frame; zero if the first is
/// fixed to the world. The rows along lines act at this point.
core::Vec3 offset_of_second(const model::Model& model, const model::Joint& joint);

/// Is the reaction more than the joint bears?
bool breaks(const model::Joint& joint, const Reaction& reaction);

/// The rule by which joints break, over State::broken_in alone: what a world does next follows from its
/// state, whichever engine steps it. A joint whose reaction in a step exceeds what it bears stops acting from
/// the next step on: it has no rows, its limits, motors and suspension go with it, it connects no island, and
/// its bodies may touch (TouchRule). It stays broken. Joints of sleeping bodies are not checked.
///
/// A joint that an event of step s releases breaks in the same way after step s - 1, whatever its load, so
/// that it no longer acts in step s; its bodies are woken for that (Sleepers::islands_called()). If it still
/// holds later, in a state from elsewhere, it breaks after the first step.
class Breakage {
 public:
  using GetReaction = std::function<Reaction(int joint)>;

  /// `model` is borrowed.
  explicit Breakage(const model::Model& model);

  /// Fills in a missing `broken_in`, with all joints whole.
  void start(model::State& state) const;
  /// After step `step`: breaks those of `joints` whose reaction was more than they bear, or that are released
  /// in the next step; true if any broke. `reaction` is called only for joints with a strength. `joints`: all
  /// of joints(), or those that took part in the step.
  bool break_overloaded_joints(std::int64_t step, std::span<const int> joints, const GetReaction& reaction,
                               model::State& state) const;
  std::span<const int> joints() const { return joints_; }  ///< joints that can break, ascending

 private:
  bool is_released(int joint, std::int64_t step) const {
    return !released_at_.empty() && released_at_[static_cast<std::size_t>(joint)] <= step;
  }

  const model::Model* model_;
  std::vector<int> joints_;
  std::vector<std::int64_t> released_at_;  ///< [joints] step of the first release; empty: no releases
};

}  // namespace pbmpi::effects
