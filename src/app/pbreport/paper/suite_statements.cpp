#include <algorithm>
#include <cmath>

#include "app/common/format.h"
#include "app/pbreport/paper/statements.h"

namespace pbmpi::app {
namespace {

std::string islands_text(double max, double min, double mean, double stddev) {
  return format("%g, %g, %.4g, %.3g", max, min, mean, stddev);
}

PaperStatement of_islands(const PaperRow& paper, const PaperData& data) {
  PaperStatement statement{
      {"3.2", "Table 1, " + paper.scene + ": islands (max, min, avg, dev)",
       "max, min and avg within 10 %; none deviates where the paper's do not", Finding::undecidable,
       not_measured},
      islands_text(paper.islands_max, paper.islands_min, paper.islands_mean, paper.islands_stddev),
      Basis::counts,
      "jobs/figure6.sh",
      ""};
  const SuiteRun* run = data.find(paper.scene);
  if (run == nullptr) return statement;
  const core::Summary& ours = run->islands.islands;
  statement.verdict.number = islands_text(ours.max, ours.min, ours.mean, ours.stddev);
  if (paper.scene == "Battle")
    statement.remark = "no five frames with a least number of 2 and a mean of 93 deviate by less than 45";
  statement.decide(is_near(ours.max, paper.islands_max) && is_near(ours.min, paper.islands_min) &&
                       is_near(ours.mean, paper.islands_mean) &&
                       (paper.islands_stddev > 0 || ours.stddev == 0),
                   1, 1);
  return statement;
}

/// The fewest frames that allow this row's least, or largest, number with its mean and deviation: one frame
/// has that number, and the others lie together on the other side of the mean, so that deviation^2 (n - 1) >=
/// distance^2. All numbers are taken as rounded in favour of fewer.
double fewest_frames(const PaperRow& row) {
  if (row.islands_stddev == 0) return 1;
  const double rounded = row.islands_stddev == std::floor(row.islands_stddev) ? 0.5 : 0.05;
  const double away = std::max(row.islands_mean - row.islands_min, row.islands_max - row.islands_mean) - 0.5;
  return std::ceil(1 + std::pow(away / (row.islands_stddev + rounded), 2));
}

PaperStatement of_frames_of_table_1() {
  PaperStatement statement{
      {"4.1", "Table 1 is of the five frames that are measured",
       "five numbers can have the extremes, mean and deviation of every row", Finding::undecidable, ""},
      "5 frames",
      Basis::counts,
      "",
      "arithmetic on the paper's own numbers: deviation^2 (n - 1) >= (mean - min)^2 and "
      "(max - mean)^2"};
  SceneList too_few;
  for (const PaperRow& row : paper_rows()) {
    if (fewest_frames(row) > 5) too_few.add(row.scene, format("at least %.0f", fewest_frames(row)));
  }
  statement.verdict.number = too_few.empty() ? "all rows can" : "frames needed: " + too_few.text();
  statement.decide(too_few.empty(), 1, 1);
  return statement;
}

PaperStatement of_number_of_spaces(const PaperData& data) {
  PaperStatement statement{{"3.2", "Table 1: number of spaces", "the same, the larger where it has two",
                            Finding::undecidable, not_measured},
                           "",
                           Basis::counts,
                           "jobs/figure6.sh",
                           "--spaces one takes them as one"};
  SceneList ours;
  bool is_same = true;
  for (const PaperRow& paper : paper_rows()) {
    statement.papers += (statement.papers.empty() ? "" : "; ") + paper.scene + " " + paper.spaces;
    const SuiteRun* run = data.find(paper.scene);
    if (run == nullptr) continue;
    ours.add(paper.scene, std::to_string(run->islands.spaces));
    const std::size_t comma = paper.spaces.rfind(' ');
    const std::string most = comma == std::string::npos ? paper.spaces : paper.spaces.substr(comma + 1);
    is_same = is_same && std::to_string(run->islands.spaces) == most;
  }
  statement.decide(is_same, ours, num_scenes);
  return statement;
}

PaperStatement of_traffic(const PaperData& data) {
  PaperStatement statement{{"3.2", "Table 1: communication between spaces",
                            "contacts across spaces where the paper has more than none, and only there",
                            Finding::undecidable, not_measured},
                           "",
                           Basis::counts,
                           "jobs/figure6.sh",
                           "contact points a step, of a frame's last steps"};
  SceneList ours;
  bool is_same = true;
  for (const PaperRow& paper : paper_rows()) {
    statement.papers += (statement.papers.empty() ? "" : "; ") + paper.scene + " " + paper.traffic;
    const SuiteRun* run = data.find(paper.scene);
    if (run == nullptr) continue;
    ours.add(paper.scene, format("%.3g", run->islands.cross_contacts));
    is_same = is_same && (paper.traffic == "none") == (run->islands.cross_contacts == 0);
  }
  statement.decide(is_same, ours, num_scenes);
  return statement;
}

/// Frames whose number of islands differs from that of the frame before.
std::size_t changes_of(const SuiteRun& run) {
  std::size_t changes = 0;
  for (std::size_t i = 1; i < run.islands_by_frame.size(); ++i) {
    if (run.islands_by_frame[i] != run.islands_by_frame[i - 1]) ++changes;
  }
  return changes;
}

PaperStatement of_temporal_behaviour(const PaperData& data) {
  PaperStatement statement{{"3.2", "Table 1: temporal behaviour",
                            "islands change after no measured frame where it is constant, after half of them "
                            "where it is fast changing",
                            Finding::undecidable, not_measured},
                           "2-Cars constant; CrashSk, Environ, Battle2 fast changing",
                           Basis::counts,
                           "jobs/figure6.sh",
                           "words between the two are not judged"};
  SceneList ours;
  bool is_same = true;
  for (const char* scene : {"2-Cars", "CrashSk", "Environ", "Battle2"}) {
    const SuiteRun* run = data.find(scene);
    if (run == nullptr) continue;
    const std::size_t changes = changes_of(*run), steps = run->islands_by_frame.size() - 1;
    ours.add(scene, format("%zu of %zu", changes, steps));
    is_same = is_same && (std::string_view(scene) == "2-Cars" ? changes == 0 : 2 * changes >= steps);
  }
  statement.decide(is_same, ours, 4, "frames with another number: ");
  return statement;
}

/// The numbers of bodies of actors of a kind, over all scenes.
std::vector<int> bodies_of(const PaperData& data, const std::string& kind) {
  std::vector<int> numbers;
  for (const SuiteRun& run : data.suite) {
    const auto found = run.actor_bodies.find(kind);
    if (found == run.actor_bodies.end()) continue;
    for (const int number : found->second) {
      if (std::ranges::find(numbers, number) == numbers.end()) numbers.push_back(number);
    }
  }
  std::ranges::sort(numbers);
  return numbers;
}

std::string joined(const std::vector<int>& numbers) {
  std::string text;
  for (const int number : numbers) text += (text.empty() ? "" : " or ") + std::to_string(number);
  return text;
}

PaperStatement of_actors(const PaperData& data) {
  PaperStatement statement{
      {"3.2", "a human has 16 segments, a car five objects", "the same", Finding::undecidable, not_measured},
      "16; 5",
      Basis::counts,
      "jobs/figure6.sh",
      "wheels hang on hinge2 joints with a suspension, the paper's on sliders"};
  const std::vector<int> humans = bodies_of(data, "human"), cars = bodies_of(data, "car");
  if (humans.empty() || cars.empty()) return statement;
  statement.verdict.number = joined(humans) + "; " + joined(cars);
  statement.decide(humans == std::vector{16} && cars == std::vector{5}, 1, 1);
  return statement;
}

std::vector<InstructionCounts> counted_quick(const PaperData& data) {
  std::vector<InstructionCounts> counts;
  for (const CountedScene& scene : data.counts) {
    if (scene.quick) counts.push_back(*scene.quick);
  }
  return counts;
}

PaperStatement of_mix(const PaperData& data) {
  std::vector<InstructionMix> mixes;
  for (const InstructionCounts& counts : counted_quick(data)) mixes.push_back(counts.mix);
  PaperStatement statement{
      judge_mix(mixes), "34, 25, 6, 5, 30 %", Basis::instructions, "jobs/figure3.sh",
      "double precision, today's compiler; an access to memory counts besides the operation that makes it"};
  if (!mixes.empty())
    statement.decide(statement.verdict.finding == Finding::confirmed, mixes.size(), num_scenes);
  return statement;
}

PaperStatement of_collision_share(const PaperData& data) {
  std::vector<double> shares;
  for (const InstructionCounts& counts : counted_quick(data)) shares.push_back(counts.collision_share);
  PaperStatement statement{judge_collision_share(shares), "7 %, 2 to 20 %", Basis::instructions,
                           "jobs/figure3.sh", ""};
  if (!shares.empty())
    statement.decide(statement.verdict.finding == Finding::confirmed, shares.size(), num_scenes);
  return statement;
}

}  // namespace

std::vector<PaperStatement> suite_statements(const PaperData& data) {
  std::vector<PaperStatement> statements = {of_actors(data)};
  for (const PaperRow& row : paper_rows()) statements.push_back(of_islands(row, data));
  statements.push_back(of_number_of_spaces(data));
  statements.push_back(of_traffic(data));
  statements.push_back(of_temporal_behaviour(data));
  statements.push_back(of_frames_of_table_1());
  statements.push_back(of_mix(data));
  statements.push_back(of_collision_share(data));
  statements.push_back(
      undecidable("3.3", "far more floating point than SPEC INT and MiBench, more integer than SPEC FP", "-",
                  "these suites are not run here"));
  statements.push_back(undecidable("3.3", "PhysicsBench hits its caches often", "no number",
                                   "the paper gives no rate, and the modelled caches' hits are in no file"));
  return statements;
}

}  // namespace pbmpi::app
