/// The solver's work in the profiled steps of a run, island by island.
#pragma once

#include <string>
#include <vector>

#include "io/run/run_data.h"

namespace pbmpi::app {

/// An island of one step.
struct SolvedIsland {
  int rows = 0;
  double solve_s = 0;  ///< time of a solver step with this island alone
};

/// The measured frames of a run with --record-islands.
struct IslandWork {
  std::string scene, stepper;
  int iterations = 0, steps_per_frame = 0, bodies = 0;
  double frame_s = 0;                              ///< per frame, mean over the frames
  std::vector<std::vector<SolvedIsland>> islands;  ///< [frames] in the last step of each

  /// Sum of rows^3 over the islands of a frame's steps, mean over the frames: the profiled step stands for
  /// all steps of its frame.
  double cubed_rows() const;
};

/// Throws core::InputError, with `path`, for a run without --record-islands.
IslandWork island_work(const io::RunData& run, const std::string& path);

}  // namespace pbmpi::app
