#include "app/pbreport/diff/run_comparison.h"

#include <algorithm>
#include <cmath>

#include "app/pbreport/run/summary_from_file.h"

namespace pbmpi::app {
namespace {

using stepping::column_of;
using stepping::Observables;

RecordedPoses precise(const io::RunData& run, std::size_t row) {
  return {&run.position[row], &run.orientation[row]};
}

RecordedPoses estimated(const io::RunData& run, std::size_t row) {
  return {&run.estimate.position[row], &run.estimate.orientation[row]};
}

using PosesOf = RecordedPoses (*)(const io::RunData&, std::size_t);

/// Errors of the measured frames that both have, one after the other.
std::vector<analysis::PoseErrors> errors_by_frame(const RunModels& models, const io::RunData& run,
                                                  PosesOf poses, const io::RunData& reference) {
  std::vector<analysis::PoseErrors> frames;
  const std::size_t rows = std::min(run.position.size(), reference.position.size());
  for (const std::size_t row : measured_rows(reference, rows)) {
    frames.push_back(compare_recorded(models, poses(run, row), precise(reference, row)));
  }
  return frames;
}

analysis::ErrorTable summarize_all(const std::vector<analysis::PoseErrors>& frames) {
  analysis::PoseErrors all;
  for (const analysis::PoseErrors& frame : frames) all.append(frame);
  return analysis::summarize(all);
}

RunInvariants invariants_of(const RunModels& models, const io::RunData& run) {
  RunInvariants kept;
  const ObservedFrames observed = observed_frames(run);
  kept.max_penetration_m = observed.largest_measured(column_of(&Observables::max_penetration_m));
  kept.max_joint_gap_m = observed.largest_measured(column_of(&Observables::joint_gap_m));
  kept.energy_first_j = observed.first(column_of(&Observables::energy_j));
  kept.energy_last_j = observed.last(column_of(&Observables::energy_j));
  std::vector<double> stretch;
  for (const std::size_t row : measured_rows(run, run.position.size())) {
    const std::vector<double> more = recorded_stretch(models, precise(run, row));
    stretch.insert(stretch.end(), more.begin(), more.end());
  }
  kept.stretch = analysis::count_stretch(stretch);
  for (const double value : stretch) {
    if (std::isfinite(value)) kept.max_stretch = std::max(kept.max_stretch, value);
  }
  return kept;
}

}  // namespace

RunComparison compare_runs(const RunModels& models, const io::RunData& run, const io::RunData& reference,
                           const std::vector<io::RunData>& floor) {
  RunComparison result;
  const auto frames = errors_by_frame(models, run, precise, reference);
  result.num_frames = frames.size();
  result.drift = summarize_all(frames);
  for (const analysis::PoseErrors& frame : frames)
    result.drift_by_frame.push_back(analysis::summarize(frame));
  if (!run.estimate.position.empty()) {
    result.defect = summarize_all(errors_by_frame(models, run, estimated, run));
    result.estimate_drift = summarize_all(errors_by_frame(models, run, estimated, reference));
  }
  for (const io::RunData& other : floor) {
    result.floor.push_back(summarize_all(errors_by_frame(models, other, precise, reference)));
  }
  result.run = invariants_of(models, run);
  result.reference = invariants_of(models, reference);
  result.breaks = compare_breaks(run, reference);
  return result;
}

}  // namespace pbmpi::app
