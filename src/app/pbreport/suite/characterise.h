/// The numbers of the paper's Tables 1 and 2 and Figure 6 for a scene, computed from the file of a run.
#pragma once

#include <optional>
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

/// In the order of the paper's Table 1.
const std::vector<PaperRow>& paper_rows();
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

/// How much later than the longest island a schedule may end and still count as full parallelism: the
/// repeatability of one island's time on a quiet machine.
inline constexpr double cores_tolerance = 0.05;

/// A frame rate: harmonic mean over the measured frames, and how many of them were within the budget.
struct Rate {
  double harmonic_mean_hz = 0;
  double satisfied_fraction = 0;
};

struct CoreSummary {
  std::string scene;
  int cores = 0;                      ///< fewest for full parallelism in every measured frame
  double cores_mean = 0;              ///< mean over the measured frames
  double longest_share = 0;           ///< time of the longest island / time of all, mean
  double longest_share_parallel = 0;  ///< longest island / frame with islands in parallel, mean time
  double spaces_share = 1;  ///< collision detection with one core per space, relative to one piece, mean
  Rate serial, islands_parallel, spaces_parallel;
  double collide_share_serial = 0;    ///< share of collision detection in the time of the measured frames
  double collide_share_parallel = 0;  ///< with islands in parallel
};
/// Throws core::InputError (with `path`) for a run without --record-islands, or on more than one rank, whose
/// frame is not a serial time.
CoreSummary summarize_cores(const io::RunData& run, const std::string& path);

}  // namespace pbmpi::app
