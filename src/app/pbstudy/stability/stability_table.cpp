#include "app/pbstudy/stability/stability_table.h"

#include <fmt/core.h>

#include "analysis/error_bands.h"
#include "app/pbstudy/study/table_columns.h"
#include "stability/cases/verdict.h"

namespace pbmpi::app {
namespace {

using stability::Judgement;
using stability::Metric;
using stability::Verdict;

std::vector<Judgement> judge_all(const StabilityRows& rows) {
  std::vector<Judgement> judgements;
  for (std::size_t i = 0; i < rows.cases.size(); ++i) {
    const stability::HardCase& hard = rows.hard_cases[static_cast<std::size_t>(rows.cases[i].scene)];
    if (rows.cases[i].not_applicable.empty()) {
      judgements.push_back(judge(hard, rows.results[i].measurement(hard)));
    } else {
      judgements.push_back({Verdict::not_applicable, rows.cases[i].not_applicable, NAN, {NAN, NAN}, ""});
    }
  }
  return judgements;
}

std::vector<io::TableColumn> case_facts(const StabilityRows& rows) {
  using Case = const StabilityCase&;
  const auto hard = [&](Case c) -> const stability::HardCase& {
    return rows.hard_cases[static_cast<std::size_t>(c.scene)];
  };
  const auto& cases = rows.cases;
  std::vector<io::TableColumn> columns = {
      scene_column("scene", rows.scenes, cases, &StudyScene::name),
      column("group", "", cases, [&](Case c) { return hard(c).group; }),
      column("row", "", cases, [&](Case c) { return hard(c).row; }),
      column("oracle", "", cases, [&](Case c) { return hard(c).oracle; }),
      column("source", "", cases, [&](Case c) { return hard(c).source; }),
      column("setting", "", cases,
             [&](Case c) { return setting_text(rows.settings[static_cast<std::size_t>(c.setting)]); }),
      column("cut", "", cases, &StabilityCase::cut),
      column("bodies", "", cases, &StabilityCase::num_bodies),
      column("seconds", "s", cases, [&](Case c) { return hard(c).seconds; }),
  };
  add_step_columns(cases, columns);
  return columns;
}

}  // namespace

std::vector<io::TableColumn> stability_columns(const StabilityRows& rows) {
  using Result = const StabilityResult&;
  std::vector<io::TableColumn> columns = case_facts(rows);
  const std::vector<Judgement> judgements = judge_all(rows);
  using Judged = const Judgement&;
  columns.push_back(column("verdict", "", judgements, [](Judged j) {
    return std::string(stability::verdict_names[static_cast<std::size_t>(j.verdict)]);
  }));
  columns.push_back(column("decided_by", "", judgements, &Judgement::decided_by));
  columns.push_back(column("value", "", judgements, &Judgement::value));
  columns.push_back(column("value_unit", "", judgements, &Judgement::unit));
  columns.push_back(column("limit_right", "", judgements, [](Judged j) { return j.limits.right; }));
  columns.push_back(column("limit_broken", "", judgements, [](Judged j) { return j.limits.broken; }));
  const auto& results = rows.results;
  columns.push_back(column("broken_at", "s", results, &StabilityResult::broken_at_s));
  columns.push_back(column("simulated", "s", results, &StabilityResult::simulated_s));
  for (std::size_t m = 0; m < stability::num_metrics; ++m) {
    const stability::MetricTraits& traits = stability::metric_table[m];
    columns.push_back(column(std::string(traits.name), std::string(traits.unit), results,
                             [m](Result r) { return r.metrics[m]; }));
  }
  // The paper's category for the body that drifted farthest.
  columns.push_back(column("drift_band", "", results, [](Result r) {
    return analysis::position_band(r.metrics[static_cast<std::size_t>(Metric::drift)]);
  }));
  columns.push_back(column("row_visits", "", results, &StabilityResult::row_visits));
  columns.push_back(column("step_time", "s", results, &StabilityResult::step_time_s));
  return columns;
}

std::map<std::string, std::vector<io::TableColumn>> stability_tables(const std::vector<CurvePoint>& points,
                                                                     const std::vector<RecordedPose>& poses) {
  std::vector<io::TableColumn> curves = {column("case", "", points, &CurvePoint::case_index),
                                         column("time", "s", points, &CurvePoint::time_s),
                                         column("energy", "J", points, &CurvePoint::energy_j),
                                         column("joint_gap", "m", points, &CurvePoint::joint_gap_m),
                                         column("penetration", "m", points, &CurvePoint::penetration_m),
                                         column("drift", "m", points, &CurvePoint::drift_m)};
  std::vector<io::TableColumn> replay = {
      column("case", "", poses, &RecordedPose::case_index), column("time", "s", poses, &RecordedPose::time_s),
      column("body", "", poses, &RecordedPose::body), wide_column("pose", "", poses, &RecordedPose::pose)};
  return {{"curves", std::move(curves)}, {"poses", std::move(replay)}};
}

std::string stability_note(const StabilityRows& rows) {
  const std::vector<Judgement> judgements = judge_all(rows);
  std::string text =
      fmt::format("{:52} {:>5} {:>9} {:>7} {:>5}\n", "setting", "pass", "degraded", "broken", "n/a");
  for (std::size_t k = 0; k < rows.settings.size(); ++k) {
    std::array<int, 4> count{};
    for (std::size_t i = 0; i < rows.cases.size(); ++i) {
      if (rows.cases[i].setting == static_cast<int>(k))
        ++count[static_cast<std::size_t>(judgements[i].verdict)];
    }
    text += fmt::format("{:52} {:5} {:9} {:7} {:5}\n", setting_text(rows.settings[k]), count[0], count[1],
                        count[2], count[3]);
  }
  return text;
}

}  // namespace pbmpi::app
