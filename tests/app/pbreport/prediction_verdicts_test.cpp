#include "app/pbreport/prediction/prediction_verdicts.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pbmpi::app {
namespace {

PredictionRun run_of(const std::string& name, double hz, double predicted_hz, double satisfied = 0.5) {
  PredictionRun run;
  run.name = name;
  run.ended = run.same_hash = true;
  run.mix = {0.34, 0.25, 0.06, 0.05, 0.30};
  run.collision_share = 0.07;
  run.unpredicted = {hz, satisfied};
  run.predicted = {predicted_hz, satisfied};
  run.islands = run.base_islands = 10;
  return run;
}

/// The scene with the paper's numbers.
PredictionScene scene_of(const std::string& name) {
  PredictionScene scene;
  scene.name = name;
  scene.runs = {run_of("20Iter", 100, 105),    run_of("19Iter", 104, 109),    run_of("FEEC", 320, 330),
                run_of("FEEC+FVP6", 320, 321), run_of("FVP6", 100, 124, 0.6), run_of("FVP12", 100, 106)};
  return scene;
}

PredictionStudy study_of(std::vector<PredictionScene> scenes) {
  PredictionStudy study;
  study.fvp = "FVP6";
  study.budget_s = 1.0 / 300;
  study.scenes = std::move(scenes);
  return study;
}

PaperVerdict verdict_on(const PredictionStudy& study, const std::string& word) {
  const std::vector<PaperVerdict> all = judge_paper(study);
  const auto found = std::ranges::find_if(
      all, [&](const PaperVerdict& one) { return one.statement.find(word) != std::string::npos; });
  EXPECT_NE(found, all.end()) << word;
  return *found;
}

TEST(PaperVerdicts, confirm_what_is_as_in_the_paper) {
  PredictionScene battle = scene_of("Battle2"), fight = scene_of("Fight"), cars = scene_of("2-Cars");
  fight.runs[4].predicted.hz = cars.runs[4].predicted.hz = 103;
  for (PredictionScene* scene : {&battle, &fight}) {
    scene->runs[3].predicted.hz = 300;  // FEEC with FVP6 is slower, with fewer islands
    scene->runs[3].islands = 8;
  }
  battle.runs[5].nonfinite_frame = 2;
  for (const PaperVerdict& verdict : judge_paper(study_of({battle, fight, cars}))) {
    if (verdict.statement.find("alike") != std::string::npos) continue;  // needs runs of single phases
    EXPECT_EQ(verdict.finding, Finding::confirmed) << verdict.statement << ": " << verdict.number;
  }
}

TEST(PaperVerdicts, refute_what_is_not) {
  PredictionScene battle = scene_of("Battle2"), fight = scene_of("Fight");
  battle.runs[4].predicted.hz = 105;
  fight.runs[4].predicted.satisfied = 0.4;
  fight.runs[0].same_hash = false;
  battle.runs[0].mix = {0.2, 0.2, 0.2, 0.2, 0.2};
  for (PredictionScene* scene : {&battle, &fight}) {
    scene->runs[2].unpredicted.hz = 101;
    scene->runs[0].collision_share = 0.4;
  }
  const PredictionStudy study = study_of({battle, fight});
  for (const char* word :
       {"Battle2", "Fight", "raises the frame rate by 220", "less attractive", "slows three tests", "1e-12",
        "leaves the result", "34 %", "collision detection is"}) {
    const PaperVerdict verdict = verdict_on(study, word);
    EXPECT_EQ(verdict.finding, Finding::refuted) << verdict.statement << ": " << verdict.number;
    EXPECT_FALSE(verdict.number.empty());
  }
}

TEST(PaperVerdicts, decide_nothing_where_nothing_was_measured) {
  PredictionScene cars = scene_of("2-Cars");
  cars.runs.resize(2);
  const PredictionStudy study = study_of({cars});
  for (const char* word : {"Battle2", "Fight", "220", "less attractive", "slows three tests",
                           "larger islands", "1e-12", "alike"})
    EXPECT_EQ(verdict_on(study, word).finding, Finding::undecidable) << word;
  for (const PaperVerdict& verdict : judge_paper(PredictionStudy()))
    EXPECT_EQ(verdict.finding, Finding::undecidable) << verdict.statement;
}

TEST(PaperVerdicts, of_the_majority_count_the_scenes_that_gain_little) {
  PredictionScene battle = scene_of("Battle2"), fight = scene_of("Fight"), cars = scene_of("2-Cars");
  fight.runs[4].predicted.hz = cars.runs[4].predicted.hz = 103;
  EXPECT_EQ(verdict_on(study_of({battle, fight, cars}), "majority").finding, Finding::confirmed);
  cars.runs[4].predicted.hz = 130;
  EXPECT_EQ(verdict_on(study_of({battle, fight, cars}), "majority").finding, Finding::refuted);
}

TEST(PaperVerdicts, decide_nothing_about_frames_that_were_all_satisfied_before) {
  PredictionScene fight = scene_of("Fight");
  fight.runs[0].unpredicted.satisfied = fight.runs[4].predicted.satisfied = 1;
  EXPECT_EQ(verdict_on(study_of({fight}), "Fight").finding, Finding::undecidable);
}

TEST(PaperVerdicts, leave_out_what_a_run_that_blew_up_gains) {
  PredictionScene fight = scene_of("Fight"), battle = scene_of("Battle2");
  fight.runs[4].predicted.hz = 110;
  battle.runs[4].predicted.hz = 1000;  // its bodies are lost, so there is less to compute
  battle.runs[4].nonfinite_frame = 3;
  const std::string number = verdict_on(study_of({fight, battle}), "less attractive").number;
  EXPECT_NE(number.find("FVP6 +10.0 %"), std::string::npos) << number;
}

TEST(PaperVerdicts, of_single_phases_go_by_their_drift) {
  PredictionScene scene = scene_of("CrashSk");
  for (const char* name : {"FVP6 collision", "FVP6 step"}) {
    scene.runs.push_back(run_of(name, 100, 101));
    scene.runs.back().drift_rms = 2e-3;
  }
  scene.runs[4].drift_rms = 1e-3;
  EXPECT_EQ(verdict_on(study_of({scene}), "alike").finding, Finding::confirmed);
  scene.runs[4].drift_rms = 1;
  EXPECT_EQ(verdict_on(study_of({scene}), "alike").finding, Finding::refuted);
}

TEST(Figure8, has_the_papers_bars) {
  const std::vector<Bar> bars = figure_8(scene_of("Fight"), "FVP6");
  const std::vector<std::pair<std::string, double>> expected = {
      {"20Iter", 100}, {"19Iter", 104}, {"FEEC", 320}, {"FVP6", 124}, {"EVP", 105}, {"FEEC+FVP6", 321}};
  ASSERT_EQ(bars.size(), expected.size());
  for (std::size_t i = 0; i < bars.size(); ++i) {
    EXPECT_EQ(bars[i].name, expected[i].first);
    EXPECT_EQ(bars[i].rate.hz, expected[i].second);
  }
}

}  // namespace
}  // namespace pbmpi::app
