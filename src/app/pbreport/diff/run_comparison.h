/// The results of "pbreport diff" on two runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/error_table.h"
#include "analysis/invariants.h"
#include "app/pbreport/diff/actors.h"
#include "app/pbreport/diff/constraint_errors.h"
#include "app/pbreport/run/broken_joints.h"
#include "app/pbreport/run/run_models.h"

namespace pbmpi::app {

/// Invariants of a run, over its measured frames.
struct RunInvariants {
  double max_penetration_m = 0, max_joint_gap_m = 0;
  double energy_first_j = 0, energy_last_j = 0;
  analysis::StretchBands stretch{};  ///< human segments of all measured frames
  double max_stretch = 0;            ///< largest of the finite ones
};

/// The errors of an actor's bodies, and of the joints whose first body is one of them.
struct ActorErrors {
  RecordedActor actor;
  analysis::ErrorTable drift;
};

struct RunComparison {
  std::size_t num_frames = 0;  ///< measured frames compared
  analysis::ErrorTable drift;
  std::vector<analysis::ErrorTable> drift_by_frame;    ///< [num_frames]
  std::vector<std::size_t> rows;                       ///< [num_frames] recorded rows of both files
  std::vector<std::int64_t> steps;                     ///< [num_frames] at the frame's end
  std::vector<double> times_s;                         ///< [num_frames] simulated time at the frame's end
  std::vector<ActorErrors> drift_by_actor;             ///< over all frames, in the order of their bodies
  std::optional<analysis::ErrorTable> defect;          ///< error of the run's estimates, with FEEC
  std::optional<analysis::ErrorTable> estimate_drift;  ///< error of the run's estimates against the reference
  std::vector<analysis::ErrorTable> floor;             ///< drift of each floor run against the reference
  RunInvariants run, reference;
  std::optional<RunConstraints> run_constraints, reference_constraints;  ///< if asked for
  BreakComparison breaks;
};

/// `run` against `reference`; require_comparable() holds for all of them.
RunComparison compare_runs(const RunModels& models, const io::RunData& run, const io::RunData& reference,
                           const std::vector<io::RunData>& floor);

}  // namespace pbmpi::app
