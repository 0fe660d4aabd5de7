#include <algorithm>
#include <cmath>

#include "app/common/format.h"
#include "app/pbreport/instructions/direct_cost.h"
#include "app/pbreport/paper/statements.h"
#include "core/statistics.h"

namespace pbmpi::app {
namespace {

PaperStatement of_instructions(const PaperRow& paper, const PaperData& data) {
  PaperStatement statement{
      {"4.1", "Figure 3, " + paper.scene + ": quick takes significantly fewer instructions",
       "half of direct's or fewer; of an extrapolation its least", Finding::undecidable, not_measured},
      "printed without numbers",
      Basis::instructions,
      "jobs/figure3.sh",
      ""};
  const auto scene = std::ranges::find(data.counts, paper.scene, &CountedScene::name);
  if (scene == data.counts.end() || !scene->quick) return statement;
  const std::vector<IslandWork> works = data.works();
  const auto direct = direct_cost(*scene, counted_cost(data.counts, works), works);
  statement.verdict.number = format("quick %.3g million a frame", 1e-6 * scene->quick->per_frame);
  if (!direct) {
    statement.remark = "direct was not counted: jobs/figure3.sh";
    return statement;
  }
  statement.verdict.number += format(", direct %.3g", 1e-6 * direct->middle);
  if (!direct->is_counted) {
    statement.verdict.number += format(" (%.3g to %.3g)", 1e-6 * direct->least, 1e-6 * direct->most);
    statement.remark = "direct extrapolated with the cubed rows of the islands";
  }
  statement.decide(direct->least >= 2 * scene->quick->per_frame, 1, 1);
  return statement;
}

struct Shares {
  SceneList text;
  std::vector<double> values;
};

Shares shares_of(const PaperData& data, double CoreSummary::*share) {
  Shares shares;
  for (const SuiteRun& run : data.suite) {
    shares.values.push_back(run.cores.*share);
    shares.text.add(run.islands.scene, percent(run.cores.*share));
  }
  return shares;
}

PaperStatement of_physics_share(const PaperData& data) {
  PaperStatement statement{
      {"4.1.1", "physics of the islands takes 92 % of the time on average",
       "what is left, 8 %, within half and twice: 84 to 96 %", Finding::undecidable, not_measured},
      "92 %",
      Basis::clock,
      "jobs/figure6.sh",
      "all but collision detection; ODE finds islands within its step"};
  const Shares shares = shares_of(data, &CoreSummary::collide_share_serial);
  if (shares.values.empty()) return statement;
  const double physics = 1 - core::summarize(shares.values).mean;
  statement.verdict.number = percent(physics) + "; collision: " + shares.text.text();
  statement.decide(physics >= 0.84 && physics <= 0.96, shares.values.size(), num_scenes);
  return statement;
}

PaperStatement of_parallel_collision(const PaperData& data) {
  PaperStatement statement{{"4.1.1", "with parallel islands collision detection takes 20 % on average",
                            "within half and twice: 10 to 40 %", Finding::undecidable, not_measured},
                           "20 %",
                           Basis::clock,
                           "jobs/figure6.sh",
                           "a core an island, no overheads"};
  const Shares shares = shares_of(data, &CoreSummary::collide_share_parallel);
  if (shares.values.empty()) return statement;
  const double mean = core::summarize(shares.values).mean;
  statement.verdict.number = percent(mean) + ": " + shares.text.text();
  statement.decide(mean >= 0.1 && mean <= 0.4, shares.values.size(), num_scenes);
  return statement;
}

PaperStatement of_largest_collision(const PaperData& data) {
  PaperStatement statement{
      {"4.1.1", "with parallel islands collision detection takes 55 % at most",
       "its largest share within half and twice: at least 27.5 %", Finding::undecidable, not_measured},
      "55 %",
      Basis::clock,
      "jobs/figure6.sh",
      ""};
  const Shares shares = shares_of(data, &CoreSummary::collide_share_parallel);
  if (shares.values.empty()) return statement;
  const auto most = std::ranges::max_element(shares.values);
  statement.verdict.number = percent(*most) + ", " +
                             data.suite[static_cast<std::size_t>(most - shares.values.begin())].islands.scene;
  statement.decide(*most >= 0.275, shares.values.size(), num_scenes);
  return statement;
}

PaperStatement of_most_islands(const PaperData& data) {
  PaperStatement statement{{"4.2", "the maximum island count in the suite is 337", "within 10 %",
                            Finding::undecidable, not_measured},
                           "337",
                           Basis::counts,
                           "jobs/figure6.sh",
                           ""};
  if (data.suite.empty()) return statement;
  const SuiteRun& most =
      *std::ranges::max_element(data.suite, {}, [](const SuiteRun& run) { return run.islands.islands.max; });
  statement.verdict.number = format("%.0f, ", most.islands.islands.max) + most.islands.scene;
  statement.decide(is_near(most.islands.islands.max, 337), data.suite.size(), num_scenes);
  return statement;
}

PaperStatement of_cores(const PaperRow& paper, const PaperData& data) {
  PaperStatement statement{{"4.2", "Table 2, " + paper.scene + ": cores for full parallelization",
                            "within one core or 10 %", Finding::undecidable, not_measured},
                           std::to_string(paper.cores),
                           Basis::clock,
                           "jobs/figure6.sh",
                           ""};
  const SuiteRun* run = data.find(paper.scene);
  if (run == nullptr) return statement;
  statement.verdict.number = std::to_string(run->cores.cores);
  statement.remark =
      format("the worst frame, 5 %% above the longest island; mean %.1f", run->cores.cores_mean);
  const double away = std::abs(run->cores.cores - paper.cores);
  statement.decide(away <= std::max(1.0, 0.1 * paper.cores), 1, 1);
  return statement;
}

PaperStatement of_few_cores(const PaperData& data) {
  PaperStatement statement{{"4.2", "most scenes of many islands are satisfied with less than five cores",
                            "most of those with 90 islands or more, 100CrSk left out as the paper does",
                            Finding::undecidable, not_measured},
                           "< 5",
                           Basis::clock,
                           "jobs/figure6.sh",
                           ""};
  SceneList cores;
  std::size_t few = 0;
  for (const SuiteRun& run : data.suite) {
    if (run.islands.islands.mean < 90 || run.islands.scene == "100CrSk") continue;
    cores.add(run.islands.scene, std::to_string(run.cores.cores));
    if (run.cores.cores < 5) ++few;
  }
  if (cores.empty()) return statement;
  statement.verdict.number = cores.text();
  statement.decide(2 * few > cores.size(), data.suite.size(), num_scenes);
  return statement;
}

}  // namespace

std::vector<PaperStatement> performance_statements(const PaperData& data) {
  std::vector<PaperStatement> statements;
  for (const PaperRow& row : paper_rows()) statements.push_back(of_instructions(row, data));
  statements.push_back(of_physics_share(data));
  statements.push_back(of_parallel_collision(data));
  statements.push_back(of_largest_collision(data));
  statements.push_back(of_most_islands(data));
  for (const PaperRow& row : paper_rows()) statements.push_back(of_cores(row, data));
  statements.push_back(of_few_cores(data));
  return statements;
}

}  // namespace pbmpi::app
