#include <algorithm>
#include <cmath>

#include "app/common/format.h"
#include "app/pbreport/paper/statements.h"

namespace pbmpi::app {
namespace {

/// At this gain or above parallel islands count as a benefit, below as little improvement.
constexpr double benefit = 1.5;
constexpr const char* our_processor = "ours is taken to be no slower than the paper's 2.4 GHz Pentium 4";

bool is_simple(const std::string& scene) {
  return scene == "2-Cars" || scene == "10-Cars" || scene == "CrashSk";
}

std::vector<const SuiteRun*> by_serial_rate(const PaperData& data) {
  std::vector<const SuiteRun*> runs;
  for (const SuiteRun& run : data.suite) runs.push_back(&run);
  std::ranges::stable_sort(runs, [](const SuiteRun* a, const SuiteRun* b) {
    return a->cores.serial.harmonic_mean_hz > b->cores.serial.harmonic_mean_hz;
  });
  return runs;
}

PaperStatement of_simplest_scenes(const PaperData& data) {
  PaperStatement statement{{"4.2", "2-Cars, 10-Cars and CrashSk are the simple scenes",
                            "the three of the highest serial rate", Finding::undecidable, not_measured},
                           "these three",
                           Basis::clock,
                           "jobs/figure6.sh",
                           ""};
  const std::vector<const SuiteRun*> runs = by_serial_rate(data);
  if (runs.empty()) return statement;
  SceneList rates;
  for (const SuiteRun* run : runs) rates.add(run->islands.scene, rate(run->cores.serial.harmonic_mean_hz));
  statement.verdict.number = rates.text();
  const auto simple = std::count_if(
      runs.begin(), runs.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(3, runs.size())),
      [](const SuiteRun* run) { return is_simple(run->islands.scene); });
  statement.decide(simple == 3, runs.size(), num_scenes);
  return statement;
}

/// "CrashWa 40 %, ..." for frames within the budget.
SceneList satisfied(const PaperData& data, Rate CoreSummary::*of,
                    bool (*is_meant)(const std::string& scene)) {
  SceneList list;
  for (const SuiteRun& run : data.suite) {
    if (is_meant(run.islands.scene)) list.add(run.islands.scene, percent((run.cores.*of).satisfied_fraction));
  }
  return list;
}

/// The paper says its processor cannot do it; this can be judged only where ours cannot either.
void decide_by_failures(PaperStatement& statement, std::size_t num_failing, std::size_t num_measured,
                        std::size_t num_needed) {
  if (num_measured >= num_needed && num_failing < num_needed) {
    statement.remark += std::string(statement.remark.empty() ? "" : "; ") + "a faster processor cannot tell";
    return;
  }
  statement.decide(num_failing == num_needed, num_measured, num_needed);
}

std::size_t count_failing(const PaperData& data, Rate CoreSummary::*of,
                          bool (*is_meant)(const std::string& scene), double satisfied_at_most) {
  std::size_t failing = 0;
  for (const SuiteRun& run : data.suite) {
    if (is_meant(run.islands.scene) && (run.cores.*of).satisfied_fraction <= satisfied_at_most) ++failing;
  }
  return failing;
}

PaperStatement of_unsatisfied_scenes(const PaperData& data) {
  PaperStatement statement{{"4.2", "one core satisfies none of the six other scenes",
                            "confirmed if ours does not, either: a frame above 3.33 ms in each",
                            Finding::undecidable, not_measured},
                           "none",
                           Basis::clock,
                           "jobs/figure6.sh",
                           our_processor};
  const auto is_meant = [](const std::string& scene) { return !is_simple(scene); };
  const SceneList list = satisfied(data, &CoreSummary::serial, is_meant);
  if (list.empty()) return statement;
  statement.verdict.number = "satisfied: " + list.text();
  decide_by_failures(statement, count_failing(data, &CoreSummary::serial, is_meant, 0.999), list.size(), 6);
  return statement;
}

double gain_of(const SuiteRun& run, Rate CoreSummary::*parallel) {
  return (run.cores.*parallel).harmonic_mean_hz / run.cores.serial.harmonic_mean_hz;
}

PaperStatement of_worlds(const PaperData& data) {
  PaperStatement statement{{"4.2", "100CrSk: tremendous speedup from parallel threads", "ten times or more",
                            Finding::undecidable, not_measured},
                           "-",
                           Basis::clock,
                           "jobs/figure6.sh",
                           "a core for each island and each world's collision detection"};
  const SuiteRun* run = data.find("100CrSk");
  if (run == nullptr) return statement;
  const double gained = gain_of(*run, &CoreSummary::spaces_parallel);
  statement.verdict.number =
      format("%.1f times; islands alone %.1f", gained, gain_of(*run, &CoreSummary::islands_parallel));
  statement.decide(gained >= 10, 1, 1);
  return statement;
}

PaperStatement of_gains(const PaperData& data, const std::string& text, const std::string& rule,
                        const std::vector<std::string>& scenes, bool benefits) {
  PaperStatement statement{{"4.2", text, rule, Finding::undecidable, not_measured},
                           "-",
                           Basis::clock,
                           "jobs/figure6.sh",
                           "islands, then also spaces, in parallel over serial"};
  SceneList gains;
  bool is_so = true;
  for (const std::string& scene : scenes) {
    const SuiteRun* run = data.find(scene);
    if (run == nullptr) continue;
    const double islands = gain_of(*run, &CoreSummary::islands_parallel),
                 spaces = gain_of(*run, &CoreSummary::spaces_parallel);
    gains.add(scene, format("%.2f, %.2f", islands, spaces));
    is_so = is_so && (spaces >= benefit) == benefits;
  }
  statement.decide(is_so, gains, scenes.size());
  return statement;
}

PaperStatement of_humans_in_parallel(const PaperData& data) {
  PaperStatement statement{{"4.2", "Battle and Fight satisfy no frame, even in parallel",
                            "confirmed if ours satisfies none, either", Finding::undecidable, not_measured},
                           "0 %",
                           Basis::clock,
                           "jobs/figure6.sh",
                           our_processor};
  const auto is_meant = [](const std::string& scene) { return scene == "Battle" || scene == "Fight"; };
  const SceneList list = satisfied(data, &CoreSummary::spaces_parallel, is_meant);
  if (list.empty()) return statement;
  statement.verdict.number = "satisfied: " + list.text();
  decide_by_failures(statement, count_failing(data, &CoreSummary::spaces_parallel, is_meant, 0), list.size(),
                     2);
  return statement;
}

PaperStatement of_one_large_island(const PaperData& data) {
  PaperStatement statement{{"4.2", "one extremely complex island dictates the frame rate, even in parallel",
                            "the longest island is more than half of the parallel frame in CrashWa",
                            Finding::undecidable, not_measured},
                           "-",
                           Basis::clock,
                           "jobs/figure6.sh",
                           "its wall"};
  const SuiteRun* run = data.find("CrashWa");
  if (run == nullptr) return statement;
  statement.verdict.number = percent(run->cores.longest_share_parallel);
  statement.decide(run->cores.longest_share_parallel > 0.5, 1, 1);
  return statement;
}

/// Scenes whose rate with islands and spaces in parallel is below `hz`.
SceneList slower_than(const PaperData& data, double hz) {
  SceneList slow;
  for (const SuiteRun& run : data.suite) {
    const double reached = run.cores.spaces_parallel.harmonic_mean_hz;
    if (reached < hz) slow.add(run.islands.scene, rate(reached));
  }
  return slow;
}

PaperStatement of_30_fps(const PaperData& data) {
  PaperStatement statement{{"5.2.1", "in parallel all scenes but one achieve 30 frames a second",
                            "eight of nine or all", Finding::undecidable, not_measured},
                           "8 of 9",
                           Basis::clock,
                           "jobs/figure6.sh",
                           "this machine's processor"};
  if (data.suite.empty()) return statement;
  const SceneList slow = slower_than(data, 30);
  statement.verdict.number = format("%zu of %zu", data.suite.size() - slow.size(), data.suite.size()) +
                             (slow.empty() ? "" : "; slower: " + slow.text());
  statement.decide(slow.size() <= 1, data.suite.size(), num_scenes);
  return statement;
}

PaperStatement of_300_fps(const PaperData& data) {
  PaperStatement statement{
      {"5.2.1", "in parallel many scenes cannot achieve 300 frames a second",
       "confirmed if three or more of ours cannot, either", Finding::undecidable, not_measured},
      "many",
      Basis::clock,
      "jobs/figure6.sh",
      our_processor};
  if (data.suite.empty()) return statement;
  const SceneList slow = slower_than(data, 300);
  statement.verdict.number = slow.empty() ? "all can" : "slower: " + slow.text();
  if (slow.size() < 3 && data.suite.size() >= num_scenes) {
    statement.remark += "; a faster processor cannot tell";
  } else {
    statement.decide(true, data.suite.size(), num_scenes);
  }
  return statement;
}

PaperStatement of_distance(const PaperData& data) {
  PaperStatement statement{
      {"5", "even in parallel CrashWa, Environ, Battle, Fight and Battle2 are not satisfied",
       "confirmed if ours does not, either: a frame above 3.33 ms in each", Finding::undecidable,
       not_measured},
      "none of five",
      Basis::clock,
      "jobs/figure6.sh",
      our_processor};
  const auto is_meant = [](const std::string& scene) {
    return std::ranges::find(figure_8_scenes, scene) != figure_8_scenes.end();
  };
  const SceneList list = satisfied(data, &CoreSummary::spaces_parallel, is_meant);
  if (list.empty()) return statement;
  statement.verdict.number = "satisfied: " + list.text();
  decide_by_failures(statement, count_failing(data, &CoreSummary::spaces_parallel, is_meant, 0.999),
                     list.size(), figure_8_scenes.size());
  return statement;
}

PaperStatement of_parallel_execution(const PaperData& data) {
  PaperStatement statement{{"6", "parallel execution satisfies the requirements of several benchmarks",
                            "all frames of two scenes or more, and of more than with one core",
                            Finding::undecidable, not_measured},
                           "several",
                           Basis::clock,
                           "jobs/figure6.sh",
                           "a core for each island and space, no overheads; this machine's processor"};
  if (data.suite.empty()) return statement;
  SceneList serial, parallel;
  for (const SuiteRun& run : data.suite) {
    if (run.cores.serial.satisfied_fraction == 1) serial.add(run.islands.scene, "");
    if (run.cores.spaces_parallel.satisfied_fraction == 1) parallel.add(run.islands.scene, "");
  }
  statement.verdict.number =
      format("%zu scenes with one core, %zu in parallel", serial.size(), parallel.size());
  if (serial.size() >= num_scenes) {
    statement.remark += "; none is left";
  } else {
    statement.decide(parallel.size() >= 2 && parallel.size() > serial.size(), data.suite.size(), num_scenes);
  }
  return statement;
}

}  // namespace

std::vector<PaperStatement> parallel_statements(const PaperData& data) {
  return {
      undecidable("4.2", "Figure 6: bars of frame rates", "printed without numbers",
                  "ours are in the page's figure; what the text says of them is judged below"),
      of_simplest_scenes(data),
      of_unsatisfied_scenes(data),
      of_worlds(data),
      of_gains(data, "Battle and Fight benefit from parallel threads", "1.5 times or more in both",
               {"Battle", "Fight"}, true),
      of_humans_in_parallel(data),
      of_gains(data, "the remaining scenes see little or no improvement", "less than 1.5 times in each",
               {"CrashWa", "Environ", "Battle2"}, false),
      of_one_large_island(data),
      of_distance(data),
      of_30_fps(data),
      of_300_fps(data),
      of_parallel_execution(data),
  };
}

}  // namespace pbmpi::app
