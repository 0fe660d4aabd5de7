/// Which islands of a world get one substep instead of all, where a run names a tolerance.
#pragma once

#include <span>
#include <vector>

#include "model/model.h"
#include "model/state.h"
#include "solver/parts/step_islands.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// An island is quiet in a step in which no point of it moves farther than the tolerance: the carried forces
/// hold it, and one substep finds the small changes. A body's displacement is that of its geoms' farthest
/// point, from the displacement of its centre and its rotation.
///
/// Quiet islands are predicted from the velocities at the start of the step, and checked after it: a step of
/// one substep is on trial. If a body has moved farther, or its final velocity would move it farther, its
/// island is put back and gets all substeps: an island that begins to fall, or is pushed by a newcomer, is in
/// motion from that step on. An island's substeps thus depend on nothing but its own state.
class QuietIslands {
 public:
  /// `model` is borrowed; spares_substeps(settings).
  QuietIslands(const model::Model& model, const stepping::StepperSettings& settings);

  /// By the velocities in `state`, may a body be in a quiet island?
  bool is_slow(int body, const model::State& state) const { return way_m(body, state) <= tolerance_m_; }
  /// Predicts which of these bodies, which make up whole islands, are in quiet islands.
  void foresee(std::span<const int> bodies, StepIslands& islands, const model::State& before);
  /// Makes no body quiet, without checking any.
  void foresee_none();
  /// Bodies of the last foresee() that are in quiet islands, in the order in which they were given.
  std::span<const int> bodies() const { return quiet_; }
  bool contains(int body) const { return is_quiet_[static_cast<std::size_t>(body)] != 0; }

  /// Appends to `far` those of `bodies`, which make up whole quiet islands, in whose island any body has
  /// moved too far after all.
  void judge(std::span<const int> bodies, StepIslands& islands, const model::State& before,
             const model::State& after, std::vector<int>& far);

 private:
  /// The farthest that a point of the body would move in a step at its velocities [m].
  double way_m(int body, const model::State& state) const;
  /// The farthest that a point of the body has moved between two states [m].
  double way_between_m(int body, const model::State& before, const model::State& after) const;

  double dt_s_, tolerance_m_;
  std::vector<double> radius_m_;  ///< [num_bodies] about the centre of mass
  IslandMarks far_;               ///< scratch
  std::vector<char> is_quiet_;    ///< [num_bodies]
  std::vector<int> quiet_;
};

}  // namespace pbmpi::solver
