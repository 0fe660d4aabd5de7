#include "app/pbstudy/accuracy/accuracy_table.h"

#include "app/pbstudy/study/table_columns.h"

namespace pbmpi::app {

std::vector<io::TableColumn> case_columns(const std::vector<StudyScene>& scenes,
                                          const std::vector<AccuracyCase>& cases,
                                          const std::vector<CaseResult>& results) {
  using Case = const AccuracyCase&;
  using Result = const CaseResult&;
  const auto scene_of = [&](Case c) -> const StudyScene& {
    return scenes[static_cast<std::size_t>(c.scene)];
  };
  std::vector<io::TableColumn> columns = {
      column<std::string>("scene", "", cases, [&](Case c) { return scene_of(c).source.name; }),
      column<std::string>("kind", "", cases,
                          [](Case c) { return case_kind_names[static_cast<std::size_t>(c.kind)]; }),
      column<std::int64_t>("estimate_iterations", "", cases,
                           [](Case c) { return c.estimate ? c.estimate->iterations : 0; }),
      column<std::int64_t>("own", "", cases, [](Case c) { return c.own; }),
      column<std::int64_t>("steps_per_frame", "", cases, [](Case c) { return c.steps_per_frame; }),
      column<std::int64_t>("worlds", "", cases, [&](Case c) { return scene_of(c).num_worlds; }),
      column<std::int64_t>("warmup", "", cases, [&](Case c) { return scene_of(c).warmup; }),
      column<std::int64_t>("frames", "", cases, [&](Case c) { return scene_of(c).frames; }),
      column<double>("frame_time_median", "s", results, [](Result r) { return r.frame_time_median_s; }),
      column<double>("frame_time_worst", "s", results, [](Result r) { return r.frame_time_worst_s; }),
      column<double>("frame_time_p10", "s", results, [](Result r) { return r.frame_time_p10_s; }),
      column<double>("frame_time_p90", "s", results, [](Result r) { return r.frame_time_p90_s; }),
      column<double>("rows", "", results, [](Result r) { return r.rows; }),
      column<double>("row_visits", "", results, [](Result r) { return r.row_visits; }),
      column<double>("joint_gap", "m", results, [](Result r) { return r.max_joint_gap_m; }),
      column<double>("penetration", "m", results, [](Result r) { return r.max_penetration_m; }),
      column<double>("energy_change", "J", results, [](Result r) { return r.energy_change_j; }),
      column<double>("momentum_change", "kg m s-1", results, [](Result r) { return r.momentum_change_ns; }),
      column<double>("stretch", "", results, [](Result r) { return r.max_stretch; }),
      column<double>("solve_residual", "m", results, [](Result r) { return r.solve_residual; }),
      column<double>("solve_iterations", "", results, [](Result r) { return r.solve_iterations; }),
      column<double>("rest_fallen", "", results, [](Result r) { return r.rest.fallen; }),
      column<double>("rest_fell_at", "s", results, [](Result r) { return r.rest.fell_at_s; }),
      column<double>("rest_creep", "m/s", results, [](Result r) { return r.rest.creep_m_s; }),
      column<double>("rest_energy_gain", "J", results, [](Result r) { return r.rest.energy_gain_j; }),
  };
  add_step_columns(cases, columns);
  add_errors("defect", &CaseResult::defect, results, columns);
  add_errors("own_defect", &CaseResult::own_defect, results, columns);
  add_errors("drift", &CaseResult::drift, results, columns);
  return columns;
}

}  // namespace pbmpi::app
