/// The effect "breakable_joints" in one ODE world.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "effects/breakage.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// ODE tells what a joint does to its bodies once it has somewhere to write it (dJointSetFeedback). A broken
/// joint is disabled, and keeps its place: attached anew, it would take the pose of that moment for its zero.
class Breaking {
 public:
  /// `model` is borrowed. `measures`: with the pass; without it only what a state says is broken is.
  Breaking(const model::Model& model, const std::vector<dJointID>& joints, bool measures);

  /// As in model::State.
  const std::vector<std::int32_t>& broken_in() const { return state_.broken_in; }
  /// The world stands in a state with these from now on; true if other joints hold than before.
  bool start(const std::vector<std::int32_t>& broken_in);

  /// Before the solver moves the bodies: where the torques are taken (effects::Reaction).
  void note_places();
  /// After the solve of step `step`; true if anything broke. `rest`: as in model::State.
  bool strain(std::int64_t step, std::span<const model::Rest> rest);

 private:
  /// A joint that can break.
  struct Watched {
    int joint = 0;
    model::Vec3 from_centre;  ///< of the first body to where the torque is taken [m], world frame
    dJointFeedback feedback;
  };

  model::Vec3 place_from_centre(const model::Joint& joint, dJointID id) const;
  void show();

  const model::Model* model_;
  std::vector<dJointID> joints_;
  effects::Breakage rule_;
  bool measures_;
  model::State state_;            ///< broken_in and rest alone
  std::vector<Watched> watched_;  ///< ODE keeps pointers to them
};

}  // namespace pbmpi::ode
