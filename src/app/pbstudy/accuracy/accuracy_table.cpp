#include "app/pbstudy/accuracy/case_runner.h"

#include "app/pbstudy/study/table_columns.h"

namespace pbmpi::app {

std::vector<io::TableColumn> case_columns(const std::vector<StudyScene>& scenes,
                                          const std::vector<AccuracyCase>& cases,
                                          const std::vector<CaseResult>& results) {
  using Case = const AccuracyCase&;
  using Result = const CaseResult&;
  std::vector<io::TableColumn> columns = {
      scene_column("scene", scenes, cases, &StudyScene::name),
      column("kind", "", cases, [](Case c) { return case_kind_names[static_cast<std::size_t>(c.kind)]; }),
      column("estimate_iterations", "", cases,
             [](Case c) { return c.estimate ? c.estimate->iterations : 0; }),
      column("own", "", cases, &AccuracyCase::own),
      column("steps_per_frame", "", cases, &AccuracyCase::steps_per_frame),
      scene_column("worlds", scenes, cases, &StudyScene::num_worlds),
      scene_column("warmup", scenes, cases, &StudyScene::warmup),
      scene_column("frames", scenes, cases, &StudyScene::frames),
      column("frame_time_median", "s", results, &CaseResult::frame_time_median_s),
      column("frame_time_worst", "s", results, &CaseResult::frame_time_worst_s),
      column("frame_time_p10", "s", results, &CaseResult::frame_time_p10_s),
      column("frame_time_p90", "s", results, &CaseResult::frame_time_p90_s),
      column("rows", "", results, &CaseResult::rows),
      column("row_visits", "", results, &CaseResult::row_visits),
      column("joint_gap", "m", results, &CaseResult::max_joint_gap_m),
      column("penetration", "m", results, &CaseResult::max_penetration_m),
      column("energy_change", "J", results, &CaseResult::energy_change_j),
      column("momentum_change", "kg m s-1", results, &CaseResult::momentum_change_ns),
      column("stretch", "", results, &CaseResult::max_stretch),
      column("solve_iterations", "", results, &CaseResult::solve_iterations),
      wide_column("determined", "", results, &CaseResult::determined),
      wide_column("within", "", results, &CaseResult::within),
      column("rest_fallen", "", results, [](Result r) { return r.rest.fallen; }),
      column("rest_fell_at", "s", results, [](Result r) { return r.rest.fell_at_s; }),
      column("rest_creep", "m/s", results, [](Result r) { return r.rest.creep_m_s; }),
      column("rest_energy_gain", "J", results, [](Result r) { return r.rest.energy_gain_j; }),
  };
  add_step_columns(cases, columns);
  add_errors("defect", &CaseResult::defect, results, columns);
  add_errors("own_defect", &CaseResult::own_defect, results, columns);
  add_errors("drift", &CaseResult::drift, results, columns);
  return columns;
}

}  // namespace pbmpi::app
