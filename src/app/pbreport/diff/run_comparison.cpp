#include "app/pbreport/diff/run_comparison.h"

#include <algorithm>
#include <cmath>

#include "app/pbreport/run/summary_from_file.h"

namespace pbmpi::app {
namespace {

using stepping::column_of;
using stepping::Observables;

RecordedPoses precise(const RunModels& models, const io::RunData& run, std::size_t row) {
  return {&run.position[row], &run.orientation[row], broken_at(models, run, row)};
}

RecordedPoses estimated(const RunModels& models, const io::RunData& run, std::size_t row) {
  return {&run.estimate.position[row], &run.estimate.orientation[row], broken_at(models, run, row)};
}

using PosesOf = RecordedPoses (*)(const RunModels&, const io::RunData&, std::size_t);

/// Errors of the measured frames that both runs have, one after the other.
std::vector<analysis::PoseErrors> errors_by_frame(const RunModels& models, const io::RunData& run,
                                                  PosesOf poses, const io::RunData& reference) {
  std::vector<analysis::PoseErrors> frames;
  const std::size_t rows = std::min(run.position.size(), reference.position.size());
  for (const std::size_t row : measured_rows(reference, rows)) {
    frames.push_back(compare_recorded(models, poses(models, run, row), precise(models, reference, row)));
  }
  return frames;
}

analysis::ErrorTable summarize_all(const std::vector<analysis::PoseErrors>& frames) {
  analysis::PoseErrors all;
  for (const analysis::PoseErrors& frame : frames) all.append(frame);
  return analysis::summarize(all);
}

std::vector<ActorErrors> drift_by_actor(const RunModels& models, const io::RunData& run,
                                        const std::vector<analysis::PoseErrors>& frames) {
  const RecordedActors recorded = actors_of(run.bodies);
  const std::vector<std::size_t>& of_body = recorded.of_body;
  const std::vector<std::size_t> body_of_joint = bodies_of_joints(models);
  std::vector<analysis::PoseErrors> errors(recorded.list.size());
  for (const analysis::PoseErrors& frame : frames) {
    for (std::size_t i = 0; i < of_body.size(); ++i) {
      errors[of_body[i]].body_position_m.push_back(frame.body_position_m[i]);
      errors[of_body[i]].body_orientation_rad.push_back(frame.body_orientation_rad[i]);
    }
    for (const std::size_t body : body_of_joint) ++errors[of_body[body]].broken_joints;
    for (std::size_t i = 0; i < frame.joints.size(); ++i) {
      analysis::PoseErrors& of_actor = errors[of_body[body_of_joint[frame.joints[i]]]];
      of_actor.joint_position_m.push_back(frame.joint_position_m[i]);
      of_actor.joint_orientation_rad.push_back(frame.joint_orientation_rad[i]);
      --of_actor.broken_joints;
    }
  }
  std::vector<ActorErrors> actors;
  for (std::size_t i = 0; i < errors.size(); ++i)
    actors.push_back({recorded.list[i], analysis::summarize(errors[i])});
  return actors;
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
    const std::vector<double> more = recorded_stretch(models, precise(models, run, row));
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
  result.rows = measured_rows(reference, std::min(run.position.size(), reference.position.size()));
  for (const std::size_t row : result.rows) {
    result.steps.push_back(reference.recorded_step[row]);
    result.times_s.push_back(reference.recorded_time_s[row]);
  }
  result.drift_by_actor = drift_by_actor(models, reference, frames);
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
