/// The contents of figures 8 and 9, from recorded runs.
#pragma once

#include <string>
#include <vector>

#include "analysis/error_table.h"
#include "io/html/provenance.h"

namespace pbmpi::app {

/// A way to compute a scene's frames: "Iter20", "Iter19", "FEEC quick x 1".
struct FigureMethod {
  std::string label;
  bool is_estimate = false;
  int num_runs = 0;          ///< recorded; a frame's time is its least over them
  double frame_rate_hz = 0;  ///< harmonic mean over the measured frames; for an estimate: over its deliveries
  double satisfied_fraction = 0;  ///< frames, or deliveries, within the budget
  double mean_frame_s = 0;        ///< time of the precise result, or of the delivery
  analysis::ErrorTable errors;    ///< against Iter20: drift; for an estimate: of the delivered poses
  bool same_hash = false;         ///< does the run's precise state equal that of Iter20, bit for bit?
  std::vector<double> stretch;    ///< for the human segments in all measured frames; NaN: not finite
  double max_joint_gap_m = 0;     ///< in the precise result
};

struct FigureScene {
  std::string name;
  std::vector<FigureMethod> methods;        ///< Iter20 first
  std::vector<analysis::ErrorTable> floor;  ///< Iter20 with other solver seeds against Iter20

  const FigureMethod* find(const std::string& label) const;
  /// Mean time of an Iter20 frame divided by that of an estimate's delivery.
  double ratio(const FigureMethod& estimate) const {
    return methods.front().mean_frame_s / estimate.mean_frame_s;
  }
};

struct RecordedFigures {
  std::vector<FigureScene> scenes;
  std::vector<io::html::FileAttributes> files;  ///< in the order in which they were named
};

/// Sorts the runs by scene and by the stepper, iterations, seed and estimate in their files. Throws
/// core::InputError for a file that is no run, or a scene without a run of `quick` with 20 iterations.
RecordedFigures recorded_figures(const std::vector<std::string>& paths);

}  // namespace pbmpi::app
