/// The islands of a scene beside the paper's, and its rate if they had a core each, from the file of a run.
#pragma once

#include <string>
#include <vector>

#include "core/statistics.h"
#include "io/run/run_data.h"

namespace pbmpi::app {

/// The paper's numbers for one scene: Table 1 (islands, spaces) and Table 2 (cores).
struct PaperRow {
  std::string scene;
  double islands_max, islands_min, islands_mean, islands_stddev;
  std::string spaces;
  std::string traffic;  ///< between spaces
  int cores;
};

/// Null for a scene that is not in the paper.
const PaperRow* paper_row(const std::string& scene);

/// Islands and spaces over the measured frames of one run.
struct IslandSummary {
  std::string scene;
  core::Summary islands;      ///< at the end of each frame, over all worlds
  int spaces = 0;             ///< over all worlds
  bool has_profile = false;   ///< recorded with --record-islands: otherwise the next is unknown
  double cross_contacts = 0;  ///< contact points between spaces per step, mean
};
IslandSummary summarize_islands(const io::RunData& run);

/// Frame rates of a run [Hz]: harmonic means over the measured frames.
struct ParallelRates {
  double serial_hz = 0;
  double islands_hz = 0;  ///< if each island had a core: the solver takes as long as its longest island
  double spaces_hz = 0;   ///< if each space had one, too: collision detection takes as long as its longest
};
/// Throws core::InputError (with `path`) for a run without --record-islands, or on more than one rank, whose
/// frame is not a serial time.
ParallelRates parallel_rates(const io::RunData& run, const std::string& path);

}  // namespace pbmpi::app
