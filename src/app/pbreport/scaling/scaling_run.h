/// The data that a scaling report takes from the file of one run.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pbmpi::app {

/// Efficiencies of the POP centre of excellence (pop-coe.eu, "POP standard metrics"): the parallel efficiency
/// is the product of the three. Load balance = mean / largest useful time of a rank. Transfer = the fraction
/// of the elapsed time that would remain on an ideal network, where messages take no time: without the time
/// of exchanges (ship, gather) on the rank that spends the least in them. Serialisation = largest useful time
/// / that remaining time.
struct PopEfficiencies {
  double load_balance = 0, serialisation = 0, transfer = 0;
};

/// Times are for the measured frames.
struct ScalingRun {
  std::string path, created;
  std::map<std::string, std::string> attributes;  ///< of the file's root
  std::string scene, stepper, precision, decomposition;
  std::string problem;  ///< all that decides the work of a world, including seeds and number of frames
  std::string program;  ///< version, revision, compiler and instruction set
  std::string state_hash;
  bool complete = true;
  bool records_islands = false;  ///< the islands of its last steps were measured one by one
  int ranks = 0, worlds = 0, steps_per_frame = 0;
  int most_ranks_of_a_host = 0;
  int processors = 0;  ///< of root's host; 0 = unknown
  std::int64_t frames = 0;
  double budget_s = 0;
  double frame_s = 0;        ///< mean: start of a frame to the end of its gather
  double within_budget = 0;  ///< fraction of the frames
  double useful_s = 0;       ///< per frame, all ranks together
  PopEfficiencies pop;
  double root_share = 0;    ///< root's section / work, 0 where ranks own whole worlds
  double island_bound = 0;  ///< speed-up with each frame's largest island on one rank; 0 for whole worlds
  double messages = 0, bytes = 0;         ///< per frame, all ranks, inside the steps
  std::map<std::string, double> phase_s;  ///< per frame, mean over the ranks, by core::phase_names
};

/// From the seconds of each rank [ranks], and the elapsed ones.
PopEfficiencies efficiencies_of(const std::vector<double>& useful_s, const std::vector<double>& exchange_s,
                                double elapsed_s);

/// Throws core::InputError: not the file of a run, no measured frame.
ScalingRun read_scaling_run(const std::string& path);

/// Speed-up of a run if each island, then also each space, had a core: the bars of the paper's Figure 6.
struct Figure6Bars {
  std::string stepper;
  double islands = 0, spaces = 0;
};
/// From a run that recorded islands on one rank.
Figure6Bars read_figure6_bars(const ScalingRun& run);

}  // namespace pbmpi::app
