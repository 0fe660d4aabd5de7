#include <algorithm>

#include "app/common/format.h"
#include "app/pbreport/paper/figure_scenes.h"
#include "app/pbreport/paper/statements.h"

namespace pbmpi::app {
namespace {

PaperStatement of_satisfied_suite(const PaperData& data) {
  PaperStatement statement{
      {"1", "parallel execution and FEEC satisfy nearly all of the suite",
       "each frame within 3.33 ms in eight scenes: one iteration, a core for each island "
       "and space",
       Finding::undecidable, not_measured},
      "nearly all",
      Basis::clock,
      "jobs/paper.sh",
      "this machine's processor"};
  if (data.one_iteration.empty()) return statement;
  SceneList not_satisfied;
  for (const SuiteRun& run : data.one_iteration) {
    const Rate& rate = run.cores.spaces_parallel;
    if (rate.satisfied_fraction < 1) not_satisfied.add(run.islands.scene, percent(rate.satisfied_fraction));
  }
  const std::size_t num_satisfied = data.one_iteration.size() - not_satisfied.size();
  statement.verdict.number = format("%zu of %zu scenes", num_satisfied, data.one_iteration.size()) +
                             (not_satisfied.empty() ? "" : "; not all frames: " + not_satisfied.text());
  statement.decide(num_satisfied >= 8, data.one_iteration.size(), num_scenes);
  return statement;
}

std::string stretch_text(const FigureMethod& method) {
  const StretchCount count = count_stretch(method.stretch);
  const auto all = static_cast<double>(count.all);
  return percent(static_cast<double>(count.all - count.perhaps_seen) / all, 1) + " unseen, " +
         percent(static_cast<double>(count.seen) / all, 1) + " seen, most " + percent(count.most, 1);
}

PaperStatement of_perception(const PaperData& data) {
  PaperStatement statement{
      {"2.2", "changes of length below 2.7 % cannot be perceived, beyond 20 % they always are",
       "observers would have to tell", Finding::undecidable, not_measured},
      "2.7 %, 20 %",
      Basis::counts,
      "jobs/figure8_9.sh",
      "no observers here; ours is how much human segments stretch. The source (Harrison et al. 2004) has 3 % "
      "as "
      "seen with full attention, and more than 20 % as unnoticed without"};
  // All human segments of all scenes and measured frames, by method.
  std::vector<FigureMethod> joined;
  for (const FigureScene& scene : data.figures) {
    for (const FigureMethod& method : scene.methods) {
      auto same = std::ranges::find(joined, method.label, &FigureMethod::label);
      if (same == joined.end()) {
        joined.emplace_back().label = method.label;
        same = joined.end() - 1;
      }
      same->stretch.insert(same->stretch.end(), method.stretch.begin(), method.stretch.end());
    }
  }
  std::string text;
  for (const FigureMethod& method : joined) {
    if (!method.stretch.empty())
      text += (text.empty() ? "" : "; ") + method.label + ": " + stretch_text(method);
  }
  if (!text.empty()) statement.verdict.number = text;
  return statement;
}

PaperStatement of_distributed_load(const PaperData& data) {
  PaperStatement statement{{"2.2", "the load is distributed: many things happen independently",
                            "the longest island takes less than half of all islands' time in most scenes",
                            Finding::undecidable, not_measured},
                           "-",
                           Basis::clock,
                           "jobs/figure6.sh",
                           ""};
  SceneList shares;
  std::size_t distributed = 0;
  for (const SuiteRun& run : data.suite) {
    shares.add(run.islands.scene, percent(run.cores.longest_share));
    if (run.cores.longest_share < 0.5) ++distributed;
  }
  statement.decide(2 * distributed > shares.size(), shares, num_scenes, "the longest island: ");
  return statement;
}

PaperStatement of_sparse_load(const PaperData& data) {
  PaperStatement statement{{"2.2", "the load is sparse",
                            "a row has two bodies at most: less than a tenth of a scene's in most scenes",
                            Finding::undecidable, not_measured},
                           "-",
                           Basis::counts,
                           "jobs/figure6.sh",
                           ""};
  SceneList shares;
  std::size_t sparse = 0;
  for (const SuiteRun& run : data.suite) {
    const double share = 2.0 / run.work.bodies;
    shares.add(run.islands.scene, percent(share, 1));
    if (share < 0.1) ++sparse;
  }
  statement.decide(2 * sparse > shares.size(), shares, num_scenes,
                   "blocks of the Jacobian that may differ from zero: ");
  return statement;
}

}  // namespace

std::vector<PaperStatement> load_statements(const PaperData& data) {
  return {
      of_satisfied_suite(data),
      undecidable("1", "30 frames a second give the illusion of visual continuity", "30 Hz",
                  "no observers here; taken over: a frame is 1/30 s"),
      undecidable("2.2", "a tenth of the frame is for physics", "3.33 ms",
                  "the paper's assumption; taken over as the budget"),
      of_perception(data),
      of_distributed_load(data),
      of_sparse_load(data),
      undecidable("2.2", "the simulation can focus on the area around the user", "-",
                  "no users here; the effect field_of_interest does it (docs/effects.md)"),
  };
}

}  // namespace pbmpi::app
