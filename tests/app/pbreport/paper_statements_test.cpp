#include "app/pbreport/paper/statements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "stepping/run_event.h"

namespace pbmpi::app {
namespace {

/// A run with the paper's numbers, or, where it gives none, with numbers that match its words.
SuiteRun suite_run(const PaperRow& paper) {
  SuiteRun run;
  run.islands.scene = run.cores.scene = run.work.scene = paper.scene;
  run.islands.islands = {paper.islands_min, paper.islands_max, paper.islands_mean, paper.islands_stddev};
  run.islands.spaces = std::stoi(paper.spaces.substr(paper.spaces.rfind(' ') + 1));
  run.islands.cross_contacts = paper.traffic == "none" ? 0 : 3;
  run.islands_by_frame =
      paper.scene == "2-Cars" ? std::vector<double>{2, 2, 2, 2, 2} : std::vector<double>{9, 8, 7, 7, 6};
  run.cores.cores = paper.cores;
  run.cores.longest_share = paper.scene == "CrashWa" ? 0.9 : 0.2;
  run.cores.longest_share_parallel = 0.8;
  run.cores.spaces_share = 0.5;
  run.cores.collide_share_serial = 0.08;
  run.cores.collide_share_parallel = paper.scene == "100CrSk" ? 0.55 : 0.2;
  run.work.stepper = "quick";
  run.work.iterations = 20;
  run.work.steps_per_frame = 3;
  run.work.bodies = 100;
  run.work.frame_s = 1e-3;
  run.actor_bodies = {{"human", {16}}, {"car", {5}}};
  return run;
}

Rate satisfied(double hz) { return {hz, hz >= 300 ? 1.0 : 0.0}; }

/// A solver's step of `rows` rows: quick's cost grows with the rows and the iterations, direct's with the
/// cube of the rows.
IslandWork work_of(const std::string& scene, int iterations, double (*cost)(double rows)) {
  IslandWork work;
  work.scene = scene;
  work.iterations = iterations;
  work.steps_per_frame = 3;
  work.frame_s = 10e-3;
  for (const int rows : {50, 100, 200, 400, 800}) {
    const double per_iteration = iterations == 0 ? 1 : iterations;
    work.islands.push_back({{rows, cost(rows) * per_iteration}});
  }
  return work;
}
double linear(double rows) { return 1e-8 * rows; }
double cubic(double rows) { return 1e-9 * rows * rows * rows; }

analysis::ErrorSummary errors_of(analysis::BandCounts bands, double rms_m) {
  analysis::ErrorSummary errors;
  for (const std::int64_t count : bands) errors.count += count;
  errors.bands = bands;
  errors.rms = rms_m;
  return errors;
}

FigureMethod method_of(const std::string& label, analysis::BandCounts bands, double rms_m, double frame_s) {
  FigureMethod method;
  method.label = label;
  method.is_estimate = label.starts_with("FEEC");
  method.mean_frame_s = frame_s;
  method.frame_rate_hz = 1 / frame_s;
  method.satisfied_fraction = frame_s <= 1.0 / 300 ? 1 : 0;
  method.same_hash = method.is_estimate;
  method.errors.body_position = errors_of(bands, rms_m);
  method.stretch = {0.001, 0.02};
  method.max_joint_gap_m = label == "Iter1" ? 0.1 : 0.01;
  return method;
}

FigureScene figure_scene(const std::string& name) {
  // CrashWa and Battle take longest.
  const double feec_s = name == "CrashWa" || name == "Battle" ? 3e-3 : 2e-3;
  const analysis::BandCounts better = {95, 5, 0, 0, 0}, worse = {85, 15, 0, 0, 0};
  FigureScene scene;
  scene.name = name;
  scene.methods = {method_of("Iter20", {100, 0, 0, 0, 0}, 0, 3.2 * feec_s),
                   method_of("Iter19", {90, 10, 0, 0, 0}, 0.01, 3.1 * feec_s),
                   method_of("Iter1", {40, 20, 20, 10, 10}, 1, feec_s),
                   method_of("FEEC quick x 1", name == "Fight" ? worse : better, 0.01, feec_s)};
  scene.floor = {scene.methods[1].errors};
  return scene;
}

CountedScene counted(const std::string& name) {
  InstructionCounts quick{10e6, 0.07, paper_mix, 5}, direct = quick;
  direct.per_frame = 50e6;
  CountedScene scene{name, quick, direct};
  return scene;
}

StabilityMap stability_as_in_the_manual() {
  StabilityMap map;
  map.settings = {"quick, 1 x 10", "quick, 1 x 20", "quick, 1 x 40"};
  for (const char* name :
       {"hard/contact/half_embedded", "hard/contact/overlapping_rows", "hard/rest/column10"}) {
    StabilityScene scene;
    scene.name = name;
    for (const std::string& setting : map.settings) {
      StabilityCell& cell = scene.cells.emplace_back();
      cell.setting = setting;
      const bool is_robust = setting != "quick, 1 x 10";
      cell.judged.verdict = is_robust ? stability::Verdict::pass : stability::Verdict::broken;
    }
    map.scenes.push_back(scene);
  }
  return map;
}

/// A machine and programs that reproduce the paper's results.
PaperData as_in_the_paper() {
  PaperData data;
  for (const PaperRow& row : paper_rows()) {
    SuiteRun run = suite_run(row);
    const bool is_simple = row.scene == "2-Cars" || row.scene == "10-Cars" || row.scene == "CrashSk";
    const double serial_hz = is_simple ? 400 : 28;
    double parallel_hz = serial_hz * 1.1;
    if (row.scene == "100CrSk") parallel_hz = serial_hz * 50;
    if (row.scene == "Battle" || row.scene == "Fight") parallel_hz = serial_hz * 4;
    run.cores.serial = satisfied(serial_hz);
    run.cores.islands_parallel = run.cores.spaces_parallel = satisfied(parallel_hz);
    const IslandWork work = work_of(row.scene, 20, linear);
    run.work.islands = work.islands;
    data.suite.push_back(run);
    run.cores.spaces_parallel = satisfied(row.scene == "Battle2" ? 100 : 400);
    data.one_iteration.push_back(run);
    data.direct.push_back(work_of(row.scene, 0, cubic));
    data.counts.push_back(counted(row.scene));
    data.figures.push_back(figure_scene(row.scene));
  }
  data.more_iterations = {work_of("CrashWa", 40, linear), work_of("CrashWa", 80, linear)};
  data.plain = {{"CrashWa", 0}, {"hard/contact/bullets_50", 0}};
  data.stability = stability_as_in_the_manual();
  return data;
}

SuiteRun& suite_of(PaperData& data, const std::string& scene) {
  return *std::ranges::find_if(data.suite, [&](const SuiteRun& run) { return run.islands.scene == scene; });
}

std::vector<PaperStatement> all_of(const PaperData& data) {
  std::vector<PaperStatement> all;
  for (const Chapter& chapter : all_statements(data))
    all.insert(all.end(), chapter.statements.begin(), chapter.statements.end());
  return all;
}

PaperStatement statement_on(const PaperData& data, const std::string& words) {
  for (const PaperStatement& statement : all_of(data)) {
    if (statement.verdict.statement.find(words) != std::string::npos) return statement;
  }
  ADD_FAILURE() << "no statement has the words " << words;
  return {};
}

/// Expects that `change` to data as in the paper refutes the statement with these words.
void expect_refuted(const std::string& words, void (*change)(PaperData& data)) {
  PaperData data = as_in_the_paper();
  EXPECT_EQ(statement_on(data, words).verdict.finding, Finding::confirmed)
      << words << ": " << statement_on(data, words).verdict.number;
  change(data);
  const PaperStatement statement = statement_on(data, words);
  EXPECT_EQ(statement.verdict.finding, Finding::refuted) << words << ": " << statement.verdict.number;
}

TEST(PaperStatements, without_files_none_is_decided_but_what_needs_none) {
  for (const PaperStatement& statement : all_of(PaperData())) {
    const PaperVerdict& verdict = statement.verdict;
    EXPECT_FALSE(verdict.section.empty());
    EXPECT_FALSE(verdict.rule.empty()) << verdict.statement;
    const bool needs_no_run = verdict.statement.starts_with("degrees of freedom") ||
                              verdict.statement.starts_with("Table 1 is of the five");
    EXPECT_EQ(verdict.finding == Finding::undecidable, !needs_no_run) << verdict.statement;
    const bool is_missing = verdict.number == not_measured;
    EXPECT_EQ(is_missing, !needs_no_run && statement.basis != Basis::nothing) << verdict.statement;
    EXPECT_TRUE(!is_missing || !statement.command.empty()) << verdict.statement << ": what measures it?";
    EXPECT_TRUE(is_missing || needs_no_run || !statement.remark.empty())
        << verdict.statement << ": why can nothing here decide it?";
  }
}

TEST(PaperStatements, a_machine_on_which_all_is_as_in_the_paper_refutes_only_its_arithmetic) {
  for (const PaperStatement& statement : all_of(as_in_the_paper())) {
    const PaperVerdict& verdict = statement.verdict;
    if (statement.basis == Basis::nothing || statement.basis == Basis::prediction) continue;
    if (verdict.statement.starts_with("changes of length")) continue;  // about observers
    // CrashWa's and Battle's numbers of Table 1 cannot come from five frames, whatever is measured.
    const bool is_arithmetic = verdict.statement.starts_with("Table 1 is of the five");
    EXPECT_EQ(verdict.finding, is_arithmetic ? Finding::refuted : Finding::confirmed)
        << verdict.statement << ": " << verdict.number << "; " << statement.remark;
  }
}

TEST(PaperStatements, table_1_cannot_be_of_five_frames) {
  const std::string number = statement_on(PaperData(), "Table 1 is of the five").verdict.number;
  EXPECT_NE(number.find("CrashWa at least 7"), std::string::npos) << number;
  EXPECT_NE(number.find("Battle at least 25"), std::string::npos) << number;
  EXPECT_EQ(number.find("Fight"), std::string::npos) << number;
}

TEST(PaperStatements, about_all_scenes_stay_open_as_long_as_one_is_missing) {
  PaperData data = as_in_the_paper();
  data.suite.pop_back();
  const PaperStatement share = statement_on(data, "takes 92 %");
  EXPECT_EQ(share.verdict.finding, Finding::undecidable);
  EXPECT_NE(share.remark.find("8 of 9 scenes"), std::string::npos) << share.remark;
  EXPECT_EQ(statement_on(data, "Table 2, Fight").verdict.finding, Finding::confirmed);
  const PaperStatement missing = statement_on(data, "Table 2, Battle2");
  EXPECT_EQ(missing.verdict.number, not_measured);
  EXPECT_EQ(missing.command, "jobs/figure6.sh");
}

TEST(PaperStatements, of_table_1_are_within_ten_per_cent) {
  expect_refuted("Table 1, Environ",
                 [](PaperData& data) { suite_of(data, "Environ").islands.islands.max = 300; });
  expect_refuted("Table 1, 2-Cars",
                 [](PaperData& data) { suite_of(data, "2-Cars").islands.islands.stddev = 0.1; });
  expect_refuted("maximum island count", [](PaperData& data) {
    for (SuiteRun& run : data.suite) run.islands.islands.max = 200;
  });
  expect_refuted("Table 1: number of spaces",
                 [](PaperData& data) { suite_of(data, "Fight").islands.spaces = 9; });
  expect_refuted("communication between",
                 [](PaperData& data) { suite_of(data, "Fight").islands.cross_contacts = 0; });
  expect_refuted("temporal behaviour",
                 [](PaperData& data) { suite_of(data, "2-Cars").islands_by_frame.back() = 1; });
  expect_refuted("16 segments", [](PaperData& data) {
    suite_of(data, "Fight").actor_bodies["human"] = {15, 16};
  });
}

TEST(PaperStatements, of_table_2_are_within_a_core_or_a_tenth) {
  expect_refuted("Table 2, CrashWa", [](PaperData& data) { suite_of(data, "CrashWa").cores.cores = 5; });
  PaperData data = as_in_the_paper();
  suite_of(data, "CrashWa").cores.cores = 4;
  suite_of(data, "100CrSk").cores.cores = 91;
  EXPECT_EQ(statement_on(data, "Table 2, CrashWa").verdict.finding, Finding::confirmed);
  EXPECT_EQ(statement_on(data, "Table 2, 100CrSk").verdict.finding, Finding::confirmed);
  expect_refuted("less than five cores", [](PaperData& all) {
    for (SuiteRun& run : all.suite) run.cores.cores = 6;
  });
}

TEST(PaperStatements, of_shares_are_within_half_and_twice) {
  expect_refuted("takes 92 %", [](PaperData& data) {
    for (SuiteRun& run : data.suite) run.cores.collide_share_serial = 0.17;
  });
  expect_refuted("takes 20 %", [](PaperData& data) {
    for (SuiteRun& run : data.suite) run.cores.collide_share_parallel = 0.41;
  });
  expect_refuted("takes 55 %", [](PaperData& data) {
    for (SuiteRun& run : data.suite) run.cores.collide_share_parallel = 0.27;
  });
  expect_refuted("most expensive part",
                 [](PaperData& data) { suite_of(data, "Fight").cores.collide_share_serial = 0.5; });
  expect_refuted("load is distributed", [](PaperData& data) {
    for (SuiteRun& run : data.suite) run.cores.longest_share = 0.5;
  });
  expect_refuted("load is sparse", [](PaperData& data) {
    for (SuiteRun& run : data.suite) run.work.bodies = 20;
  });
  expect_refuted("number of spaces has", [](PaperData& data) {
    for (SuiteRun& run : data.suite) run.cores.spaces_share = 0.8;
  });
  expect_refuted("dictates",
                 [](PaperData& data) { suite_of(data, "CrashWa").cores.longest_share_parallel = 0.5; });
}

TEST(PaperStatements, of_gains_in_parallel_part_at_one_and_a_half) {
  const auto set = [](PaperData& data, const std::string& scene, double gain) {
    CoreSummary& cores = suite_of(data, scene).cores;
    cores.spaces_parallel.harmonic_mean_hz = gain * cores.serial.harmonic_mean_hz;
  };
  PaperData data = as_in_the_paper();
  set(data, "Fight", 1.4);
  EXPECT_EQ(statement_on(data, "Battle and Fight benefit").verdict.finding, Finding::refuted);
  set(data, "Environ", 1.6);
  EXPECT_EQ(statement_on(data, "remaining scenes").verdict.finding, Finding::refuted);
  set(data, "100CrSk", 9);
  EXPECT_EQ(statement_on(data, "tremendous").verdict.finding, Finding::refuted);
}

TEST(PaperStatements, about_what_their_processor_cannot_do_are_told_only_by_failures) {
  for (const char* words :
       {"one core satisfies none", "satisfy no frame", "are not satisfied", "300 frames"}) {
    PaperData data = as_in_the_paper();
    EXPECT_EQ(statement_on(data, words).verdict.finding, Finding::confirmed) << words;
    for (SuiteRun& run : data.suite) run.cores.serial = run.cores.spaces_parallel = satisfied(1000);
    const PaperStatement statement = statement_on(data, words);
    EXPECT_EQ(statement.verdict.finding, Finding::undecidable) << words;
    EXPECT_NE(statement.remark.find("a faster processor cannot tell"), std::string::npos) << statement.remark;
  }
}

TEST(PaperStatements, of_30_frames_a_second_leave_one_scene_out) {
  PaperData data = as_in_the_paper();
  for (SuiteRun& run : data.suite) run.cores.spaces_parallel = satisfied(30);
  EXPECT_EQ(statement_on(data, "30 frames a second").verdict.finding, Finding::undecidable)
      << "the first such statement is about observers";
  const auto in_parallel = [&] { return statement_on(data, "in parallel all scenes but one").verdict; };
  EXPECT_EQ(in_parallel().finding, Finding::confirmed);
  suite_of(data, "Environ").cores.spaces_parallel = satisfied(29);
  EXPECT_EQ(in_parallel().finding, Finding::confirmed);
  suite_of(data, "Battle2").cores.spaces_parallel = satisfied(29);
  EXPECT_EQ(in_parallel().finding, Finding::refuted);
}

TEST(PaperStatements, of_growth_go_by_the_exponent) {
  expect_refuted("O(m^3)", [](PaperData& data) {
    for (IslandWork& work : data.direct) work = work_of(work.scene, 0, linear);
  });
  expect_refuted("O(m i)", [](PaperData& data) {
    for (SuiteRun& run : data.suite) run.work.islands = work_of(run.islands.scene, 20, cubic).islands;
  });
  expect_refuted("O(m i)", [](PaperData& data) { data.more_iterations[1] = work_of("CrashWa", 80, cubic); });
  expect_refuted("outperforms", [](PaperData& data) { data.direct.front().frame_s = 1.9e-3; });
}

TEST(PaperStatements, of_engines_need_what_holds) {
  expect_refuted("high speed even", [](PaperData& data) { data.plain.back().passages = 1; });
  expect_refuted("a penetration is", [](PaperData& data) {
    data.stability->scenes.front().cells[1].judged.verdict = stability::Verdict::degraded;
  });
  expect_refuted("large steps", [](PaperData& data) {
    suite_of(data, "Fight").events[stepping::event_kind::energy_gain] = 1;
  });
  expect_refuted("20 iterations are the minimum", [](PaperData& data) {
    for (StabilityScene& scene : data.stability->scenes) {
      scene.cells[1].judged.verdict = stability::Verdict::broken;
      scene.cells[2].judged.verdict = stability::Verdict::pass;
    }
  });
}

TEST(PaperStatements, of_instructions_count_both_steps) {
  expect_refuted("Figure 3, Battle:", [](PaperData& data) {
    for (CountedScene& scene : data.counts) scene.direct->per_frame = 19e6;
  });
  expect_refuted("34 % floating", [](PaperData& data) {
    for (CountedScene& scene : data.counts) scene.quick->mix = {0.2, 0.2, 0.2, 0.2, 0.2};
  });
  expect_refuted("7 % of the instructions", [](PaperData& data) {
    for (CountedScene& scene : data.counts) scene.quick->collision_share = 0.3;
  });
}

TEST(PaperStatements, of_direct_where_it_was_not_counted_extrapolate) {
  PaperData data = as_in_the_paper();
  CountedScene& battle = *std::ranges::find(data.counts, "Battle", &CountedScene::name);
  battle.direct.reset();
  for (IslandWork* work : {&suite_of(data, "Battle").work}) {
    for (std::vector<SolvedIsland>& step : work->islands) step.front().rows *= 2;
  }
  // Eight times the cubes, hence eight times the solver's part of 50 million; collision is 7 % of quick's 10.
  const PaperStatement statement = statement_on(data, "Figure 3, Battle:");
  EXPECT_EQ(statement.verdict.number, "quick 10 million a frame, direct 373 (373 to 373)");
  EXPECT_EQ(statement.verdict.finding, Finding::confirmed);
}

TEST(PaperStatements, of_feec_refute_what_differs) {
  const auto of_feec = [](FigureScene& scene) -> FigureMethod& { return scene.methods[3]; };
  PaperData data = as_in_the_paper();
  of_feec(data.figures.front()).same_hash = false;
  EXPECT_EQ(statement_on(data, "100 % corrected").verdict.finding, Finding::refuted);
  of_feec(data.figures.front()).stretch.push_back(0.03);
  EXPECT_EQ(statement_on(data, "imperceptible").verdict.finding, Finding::refuted);
  for (FigureScene& scene : data.figures) {
    of_feec(scene).mean_frame_s = scene.methods.front().mean_frame_s / 2;
    of_feec(scene).errors.body_position = errors_of({50, 50, 0, 0, 0}, 0.05);
    of_feec(scene).satisfied_fraction = 0.8;
  }
  for (const char* words :
       {"improves performance", "comparable to those of 19", "sometimes better", "completely satisfied"})
    EXPECT_EQ(statement_on(data, words).verdict.finding, Finding::refuted) << words;
  EXPECT_TRUE(statement_on(data, "improves performance by 220 %").verdict.number.starts_with("+100 %"));
  of_feec(data.figures[4]).errors.body_position = errors_of({90, 0, 0, 0, 10}, 0.05);
  EXPECT_EQ(statement_on(data, "blow up in few").verdict.finding, Finding::refuted);
  of_feec(data.figures[4]).mean_frame_s = 1;
  EXPECT_EQ(statement_on(data, "especially difficult").verdict.finding, Finding::refuted) << "Environ";
}

TEST(PaperStatements, of_few_iterations_refute_what_differs) {
  PaperData data = as_in_the_paper();
  for (FigureScene& scene : data.figures) {
    scene.methods[2].errors.body_position = errors_of({90, 10, 0, 0, 0}, 0.05);
    scene.methods[2].max_joint_gap_m = 0.001;
  }
  for (const char* words : {"highest class", "drastically", "satisfied better"})
    EXPECT_EQ(statement_on(data, words).verdict.finding, Finding::refuted) << words;
}

TEST(PaperStatements, that_leave_no_room_are_not_decided) {
  PaperData data = as_in_the_paper();
  for (FigureScene& scene : data.figures) scene.methods.front().satisfied_fraction = 1;
  EXPECT_EQ(statement_on(data, "completely satisfied").verdict.finding, Finding::undecidable);
  for (SuiteRun& run : data.suite) run.cores.serial = satisfied(1000);
  EXPECT_EQ(statement_on(data, "requirements of several").verdict.finding, Finding::undecidable);
}

TEST(PaperStatements, of_perception_count_what_is_not_finite_as_seen) {
  PaperData data = as_in_the_paper();
  for (FigureScene& scene : data.figures)
    scene.methods[2].stretch = {0.01, 0.1, 0.3, std::numeric_limits<double>::quiet_NaN()};
  const PaperStatement statement = statement_on(data, "changes of length");
  EXPECT_EQ(statement.verdict.finding, Finding::undecidable);
  EXPECT_NE(statement.verdict.number.find("Iter1: 25.0 % unseen, 50.0 % seen, most 30.0 %"),
            std::string::npos)
      << statement.verdict.number;
}

}  // namespace
}  // namespace pbmpi::app
