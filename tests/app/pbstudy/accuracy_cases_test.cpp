#include "app/pbstudy/accuracy/accuracy_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/pbstudy/accuracy/case_runner.h"
#include "app/pbstudy/accuracy/nature.h"
#include "app/pbstudy/accuracy/own_solution.h"
#include "core/error.h"
#include "core/statistics.h"
#include "mpi/balance/partition.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

AccuracyOptions options_of(std::vector<std::string> args) {
  args.insert(args.begin(), {"--scene", "CrashSk"});
  return parse_accuracy_options(args);
}

std::vector<AccuracyCase> cases_of(const AccuracyOptions& options) {
  return make_cases({study_scene(scenes::find_scene("CrashSk"), options.overrides)}, options);
}

std::int64_t count(const std::vector<AccuracyCase>& cases, CaseKind kind) {
  return std::count_if(cases.begin(), cases.end(),
                       [kind](const AccuracyCase& one) { return one.kind == kind; });
}

std::string refusal(const std::vector<std::string>& args) {
  try {
    cases_of(options_of(args));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(AccuracyCases, all_settings_are_crossed_and_odes_steppers_have_fewer) {
  const auto cases = cases_of(options_of({"--stepper", "quick", "direct", "sor", "--iterations", "1", "20",
                                          "--substeps", "1", "2", "--precision", "single"}));
  // quick: 2 iterations; direct: one; sor: 2 iterations x 2 substeps with ODE's law, 2 substeps with the soft
  // one; each with four lengths of the step
  EXPECT_EQ(count(cases, CaseKind::setting), 4 * (2 + 1 + 4 + 2));
}

TEST(AccuracyCases, one_law_may_be_studied_alone) {
  const auto cases_with = [](const char* law) {
    return cases_of(options_of({"--stepper", "sor", "--law", law, "--iterations", "3", "--substeps", "1", "5",
                                "--precision", "double", "--dt", "0.01"}));
  };
  for (const AccuracyCase& one : cases_with("ode")) {
    if (one.kind != CaseKind::nature) {
      EXPECT_EQ(one.stepper.law, stepping::ode_law());
    }
  }
  EXPECT_EQ(count(cases_with("ode"), CaseKind::setting), 2);
  for (const AccuracyCase& one : cases_with("soft")) {
    EXPECT_EQ(one.stepper.law.name, stepping::Law::soft);
  }
  EXPECT_NE(refusal({"--law", "hard"}).find("soft, ode"), std::string::npos);
}

TEST(AccuracyCases, the_soft_law_is_measured_as_it_is_meant_to_be_used) {
  const auto cases = cases_of(options_of({"--substeps", "2", "4", "--iterations", "9", "--dt", "0.005"}));
  std::set<std::pair<int, stepping::Precision>> found;
  for (const AccuracyCase& one : cases) {
    if (one.kind != CaseKind::setting || one.stepper.law.relax == 0) continue;
    EXPECT_EQ(one.stepper.dt_s, 0.005);
    for (const stepping::StepOption& option : stepping::step_options()) {
      const bool is_varied = std::set<std::string_view>{"dt", "substeps", "precision"}.contains(option.name);
      EXPECT_TRUE(is_varied || is_default(option, one.stepper)) << option.name;
    }
    found.insert({one.stepper.substeps, one.stepper.precision});
  }
  EXPECT_EQ(found.size(), 4u);
}

TEST(AccuracyCases, tolerances_are_those_of_the_soft_law_where_it_has_substeps_to_spare) {
  const auto cases = cases_of(options_of({"--substeps", "1", "8", "--precision", "double", "--dt", "0.01",
                                          "--tolerance", "0", "0.01mm", "1mm"}));
  std::multiset<std::pair<int, double>> found;
  for (const AccuracyCase& one : cases) {
    if (one.stepper.law.relax == 0) {
      EXPECT_EQ(one.stepper.tolerance_m, 0);
    } else if (one.kind == CaseKind::setting) {
      found.insert({one.stepper.substeps, one.stepper.tolerance_m});
    }
  }
  EXPECT_EQ(found, (std::multiset<std::pair<int, double>>{{1, 0}, {8, 0}, {8, 1e-5}, {8, 1e-3}}));
}

TEST(AccuracyCases, frames_of_each_iterative_stepper_and_law_are_estimated) {
  const auto cases =
      cases_of(options_of({"--stepper", "quick", "sor", "--estimates", "0", "2", "--precision", "double"}));
  std::map<std::pair<stepping::StepperKind, int>, const AccuracyCase*> found;
  for (const AccuracyCase& one : cases) {
    EXPECT_EQ(one.estimate.has_value(), one.kind == CaseKind::estimate);
    if (one.estimate) found[{one.stepper.kind, one.stepper.law.relax}] = &one;
  }
  EXPECT_EQ(found.size(), 3u) << "quick, sor with both laws";
  EXPECT_EQ(found.at({stepping::StepperKind::quick, 0})->sweeps_a_frame(), 3 * 2);
  EXPECT_EQ(found.at({stepping::StepperKind::sor, 0})->sweeps_a_frame(), 3 * 2);
  const AccuracyCase& remembers = *found.at({stepping::StepperKind::sor, 1});
  EXPECT_EQ(remembers.estimate->substeps, 2) << "a sixth";
  EXPECT_EQ(remembers.sweeps_a_frame(), 3 * 2 * (2 + 1));
  EXPECT_EQ(count(cases_of(options_of({"--stepper", "direct"})), CaseKind::estimate), 0);
}

TEST(AccuracyCases, a_scene_has_one_nature_whatever_is_varied) {
  const auto cases = cases_of(options_of({"--nature-steps", "96", "--stepper", "quick"}));
  EXPECT_EQ(count(cases, CaseKind::nature), 1);
  for (const AccuracyCase& one : cases) {
    if (one.kind != CaseKind::nature) continue;
    EXPECT_EQ(one.steps_per_frame, 96);
    EXPECT_NEAR(one.stepper.dt_s * 96, 0.03, 1e-15);
    EXPECT_EQ(one.stepper.substeps, 1);
  }
}

TEST(AccuracyCases, max_sweeps_leaves_out_the_dear_ones) {
  for (const AccuracyCase& one : cases_of(options_of({"--max-sweeps", "40"}))) {
    if (one.kind == CaseKind::setting && one.stepper.kind == stepping::StepperKind::sor) {
      EXPECT_LE(one.sweeps(), 40);
    }
  }
}

TEST(AccuracyCases, another_step_fills_the_same_frame) {
  const auto cases = cases_of(options_of({"--dt", "0.005", "0.015"}));
  for (const AccuracyCase& one : cases) {
    EXPECT_NEAR(one.stepper.dt_s * one.steps_per_frame, 0.03, 1e-15);  // one rounding
  }
  EXPECT_NE(refusal({"--dt", "0.007"}).find("whole number"), std::string::npos);
}

TEST(AccuracyCases, every_case_has_one_owner_and_no_rank_has_all_the_work) {
  const AccuracyOptions options = options_of({});
  const std::vector<StudyScene> scenes = {study_scene(scenes::find_scene("CrashSk"), options.overrides)};
  const auto cases = make_cases(scenes, options);
  std::vector<double> cost;
  cost.reserve(cases.size());
  for (const AccuracyCase& one : cases) cost.push_back(cost_of(one, scenes.front()));
  const std::vector<int> owner = mpi::lpt_placement(cost, 3);
  ASSERT_EQ(owner.size(), cases.size());
  EXPECT_EQ(std::set<int>(owner.begin(), owner.end()), (std::set<int>{0, 1, 2}));
}

TEST(AccuracyCases, bad_values_are_named) {
  EXPECT_NE(refusal({"--iterations", "0"}).find("--iterations 0"), std::string::npos);
  EXPECT_NE(refusal({"--substeps", "-1"}).find("--substeps"), std::string::npos);
  EXPECT_NE(refusal({"--stepper", "fast"}).find("quick, direct, sor"), std::string::npos);
  EXPECT_NE(refusal({"--precision", "half"}).find("double, single"), std::string::npos);
  EXPECT_NE(refusal({"--dt", "nan"}).find("--dt"), std::string::npos);
  EXPECT_NE(refusal({"--tolerance", "1km"}).find("--tolerance 1km"), std::string::npos);
  EXPECT_NE(refusal({"--repeats", "0"}).find("--repeats"), std::string::npos);
  EXPECT_NE(refusal({"--floor-seeds", "0"}).find("--floor-seeds"), std::string::npos);
  EXPECT_NE(refusal({"--max-sweeps", "0"}).find("--max-sweeps"), std::string::npos);
  EXPECT_NE(refusal({"--nature-steps", "1"}).find("--nature-steps"), std::string::npos);
  EXPECT_NE(refusal({"--nature-steps", "5"}).find("at least 6"), std::string::npos);
  EXPECT_NE(refusal({"--nature-error", "1"}).find("--nature-error"), std::string::npos) << "1 what?";
  EXPECT_NE(refusal({"--own-iterations", "-1"}).find("--own-iterations"), std::string::npos);
  EXPECT_NE(refusal({"--own-most-iterations", "2559"}).find("at least 2560"), std::string::npos);
  EXPECT_NE(refusal({"--replicas", "0"}).find("--replicas"), std::string::npos);
  EXPECT_NE(refusal({"--warmup", "-1"}).find("--warmup"), std::string::npos);
  EXPECT_NE(refusal({"--frames", "0"}).find("--frames"), std::string::npos);
}

/// Nature of a scene as these options say, and its settings in a frame of so many steps.
struct Known {
  AccuracyOptions options;
  StudyScene scene;
  Nature nature;
  RestRunner no_rest;

  explicit Known(const std::vector<std::string>& args)
      : options(options_of(args)),
        scene(study_scene(scenes::find_scene("CrashSk"), options.overrides)),
        nature(find_nature(scene, options.nature)),
        no_rest(scene, resting_settings(scene, options.nature), 0) {}

  CaseResult run(int steps, int repeats = 1, int substeps = 1) const {
    AccuracyCase one{0, CaseKind::setting, settings_of(Way::soft, scene.frame_s / steps, options.nature),
                     steps};
    one.stepper.substeps = substeps;
    return run_case(one, scene, nature, no_rest, repeats);
  }
};

TEST(Nature, is_the_limit_of_both_ways_in_each_frame) {
  const Known known({"--nature-steps", "192"});
  ASSERT_EQ(known.nature.states.size(), 9u);
  ASSERT_EQ(known.nature.frames.size(), 5u);
  std::set<int> steps;
  for (std::size_t i = 0; i < known.nature.frames.size(); ++i) {
    const NatureFrame& frame = known.nature.frames[i];
    EXPECT_EQ(model::hash(known.nature.states[4 + i][0]), model::hash(frame.by(Way::soft).finer[0]));
    for (const WayEnds& way : frame.ways) {
      steps.insert(way.steps);
      const double moved_m = core::quantile(distances_m(way.coarser, way.finer), 0.9);
      EXPECT_TRUE(moved_m < known.options.nature.error_m || way.steps == 192) << moved_m;
    }
    const std::vector<double> apart_m = distances_m(frame.by(Way::soft).finer, frame.by(Way::ode).finer);
    for (std::size_t body = 0; body < apart_m.size(); ++body)
      EXPECT_GE(frame.uncertainty[0].body_position_m[body], apart_m[body]);
  }
  EXPECT_GT(steps.size(), 1u) << "an impact asks for more steps than a car on its wheels";
}

TEST(Nature, does_not_change_with_its_step_where_it_is_said_to_be_known) {
  const Known coarse({"--nature-steps", "96", "--frames", "1"}),
      fine({"--nature-steps", "768", "--frames", "1"});
  ASSERT_EQ(coarse.scene.warmup, 3);
  for (int body = 0; body < 37; ++body) {
    const double known_m =
        coarse.nature.frames[0].uncertainty[0].body_position_m[static_cast<std::size_t>(body)];
    if (known_m >= judged_m) continue;
    const auto& a = coarse.nature.frames[0].by(Way::soft).finer[0].position[static_cast<std::size_t>(body)];
    const auto& b = fine.nature.frames[0].by(Way::soft).finer[0].position[static_cast<std::size_t>(body)];
    EXPECT_LT((a - b).norm(), 2 * judged_m) << body;
  }
}

TEST(Nature, events_come_at_one_time_with_all_steps) {
  const StudyScene scene = study_scene(scenes::find_scene("Battle"), {});
  const Worlds own = build_worlds(scene, scene.dt_s, 1), finer = build_worlds(scene, scene.dt_s / 8, 1);
  ASSERT_FALSE(own[0]->events.empty());
  ASSERT_EQ(own[0]->events.size(), finer[0]->events.size());
  for (std::size_t i = 0; i < own[0]->events.size(); ++i)
    EXPECT_EQ(8 * own[0]->events[i].step, finer[0]->events[i].step);
}

TEST(Nature, leaves_out_bodies_that_it_does_not_determine_and_joints_at_them) {
  model::Model model;
  model.bodies.resize(3);
  model.joints.resize(2);
  model.joints[0].body_a = 0;
  model.joints[0].body_b = 1;
  model.joints[1].body_a = 2;
  analysis::PoseErrors uncertainty;
  uncertainty.body_position_m = {0, 0.002, 0.00005};
  analysis::PoseErrors errors;
  errors.body_position_m = {0.5, 1, 0.0005};
  errors.body_orientation_rad = {5, 6, 7};
  errors.joints = {0, 1};
  errors.joint_position_m = {8, 9};
  errors.joint_orientation_rad = {10, 11};
  errors.broken_joints = 1;
  WithinCounts counts;
  counts.count(uncertainty, errors);
  EXPECT_EQ(counts.determined, (std::array<std::int64_t, 3>{2, 2, 3})) << "to a tenth of 1 mm, 1 cm, 10 cm";
  EXPECT_EQ(counts.within, (std::array<std::int64_t, 3>{1, 1, 1}));
  EXPECT_EQ(counts.within_shares()[2], 1.0 / 3);
  EXPECT_TRUE(std::isnan(WithinCounts().within_shares()[0]));
  keep_judged(model, uncertainty, errors);
  EXPECT_EQ(errors.body_position_m, (std::vector<double>{0.5, 0.0005}));
  EXPECT_EQ(errors.body_orientation_rad, (std::vector<double>{5, 7}));
  EXPECT_EQ(errors.joints, (std::vector<std::size_t>{1}));
  EXPECT_EQ(errors.joint_position_m, (std::vector<double>{9}));
  EXPECT_EQ(errors.broken_joints, 1);
  uncertainty.body_position_m = {1, 1};
  analysis::PoseErrors blown_up;
  blown_up.body_position_m = {NAN, 1};
  blown_up.body_orientation_rad = {0, 0};
  model.bodies.resize(2);
  keep_judged(model, uncertainty, blown_up);
  EXPECT_EQ(blown_up.body_position_m.size(), 1u) << "nature forbids what is not finite";
}

TEST(CaseRunner, errors_fall_with_the_step_to_what_is_known_of_nature) {
  const Known known({"--nature-steps", "384"});
  const CaseResult nature = account_of(known.nature);
  const CaseResult itself = known.run(384), few = known.run(3), more = known.run(24);
  EXPECT_EQ(itself.defect.body_position.count, nature.defect.body_position.count);
  EXPECT_LE(itself.defect.body_position.max, judged_m) << "nature's own step";
  EXPECT_EQ(few.defect.body_position.count, nature.defect.body_position.count);
  EXPECT_GT(few.defect.body_position.rms, 1e-3) << "a step of 10 ms is seen in a crash";
  EXPECT_LT(more.defect.body_position.rms, few.defect.body_position.rms / 2);
  EXPECT_LT(nature.defect.body_position.max, judged_m);
  EXPECT_LE(few.within[1], more.within[1]);
  EXPECT_EQ(few.determined, nature.determined);
  EXPECT_GT(few.energy_change_j, more.energy_change_j);
  EXPECT_EQ(few.drift.body_position.count, 5 * 37);
  EXPECT_DOUBLE_EQ(few.row_visits, few.rows * 2 * 3);
}

TEST(CaseRunner, repeats_change_times_only) {
  const Known known({"--nature-steps", "24"});
  const CaseResult once = known.run(3), thrice = known.run(3, 3);
  EXPECT_EQ(once.defect.body_position.rms, thrice.defect.body_position.rms);
  EXPECT_EQ(once.max_joint_gap_m, thrice.max_joint_gap_m);
}

/// The settings, own solutions and noise floors of these options.
std::vector<AccuracyCase> own_cases_of(const std::vector<std::string>& args) {
  const auto cases = cases_of(options_of(args));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const bool at_first_step = cases[i].stepper.dt_s == cases.front().stepper.dt_s;
    const bool has_own = (cases[i].kind == CaseKind::setting && at_first_step) || is_own(cases[i].kind);
    EXPECT_EQ(cases[i].own != AccuracyCase::no_own, has_own && args.back() != "0") << i;
    if (cases[i].own == AccuracyCase::no_own) continue;
    const AccuracyCase& own = cases[static_cast<std::size_t>(cases[i].own)];
    EXPECT_EQ(own.kind, CaseKind::own);
    EXPECT_EQ(own.stepper.kind, cases[i].stepper.kind);
    EXPECT_EQ(own.stepper.dt_s, cases[i].stepper.dt_s);
    EXPECT_EQ(own.steps_per_frame, cases[i].steps_per_frame);
  }
  return cases;
}

TEST(OwnSolution, is_shared_by_all_settings_that_solve_the_same_equations) {
  const auto cases =
      own_cases_of({"--stepper", "quick", "direct", "sor", "--iterations", "1", "20", "--substeps", "1", "14",
                    "--precision", "double", "single", "--floor-seeds", "3"});
  // At the first step length: quick, direct, and sor with both laws in one and in 14 substeps.
  EXPECT_EQ(count(cases, CaseKind::own), 1 + 1 + 2 * 2);
  EXPECT_EQ(count(cases, CaseKind::own_floor), 3 * 3) << "a kind of stepper has one floor";
  std::set<std::uint64_t> seeds;
  for (const AccuracyCase& one : cases) {
    if (one.kind != CaseKind::own_floor) continue;
    seeds.insert(one.stepper.seed);
    EXPECT_EQ(one.stepper.dt_s, 0.01) << "at the scene's step";
    if (one.stepper.kind == stepping::StepperKind::sor) {
      EXPECT_EQ(one.stepper.substeps, 14);
      EXPECT_GT(one.stepper.law.relax, 0) << "of sor as it is by default";
    }
  }
  EXPECT_EQ(seeds, (std::set<std::uint64_t>{2, 3, 4}));
  EXPECT_EQ(count(own_cases_of({"--own-iterations", "0"}), CaseKind::own), 0);
}

TEST(OwnSolution, keeps_what_is_solved_and_not_how) {
  stepping::StepperSettings setting = default_settings(stepping::StepperKind::sor);
  setting.tolerance_m = 1e-5;
  setting.precision = stepping::Precision::single;
  const stepping::StepperSettings own = own_settings(setting, 1400);
  EXPECT_EQ(own.substeps, 14);
  EXPECT_EQ(own.iterations, 100) << "14 substeps share them";
  EXPECT_EQ(own.law.relax, 100);
  EXPECT_EQ(own.tolerance_m, 0) << "fewer substeps save work";
  EXPECT_EQ(own.precision, stepping::Precision::double_);
  EXPECT_EQ(own_settings(setting, 3).iterations, 1);
  const auto ode = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  EXPECT_EQ(own_settings(ode, 1200).law, stepping::ode_law());
  stepping::StepperSettings direct = default_settings(stepping::StepperKind::direct);
  direct.iterations = 7;
  EXPECT_EQ(own_settings(direct, 800).iterations, 7);
}

TEST(OwnSolution, is_what_more_iterations_come_to) {
  const AccuracyOptions options = options_of({"--stepper",
                                              "quick",
                                              "--iterations",
                                              "2",
                                              "60",
                                              "--nature-steps",
                                              "24",
                                              "--own-iterations",
                                              "160",
                                              "--own-most-iterations",
                                              "640",
                                              "--frames",
                                              "1",
                                              "--warmup",
                                              "0",
                                              "--dt",
                                              "0.01",
                                              "--estimates",
                                              "0",
                                              "--floor-seeds",
                                              "1"});
  const StudyScene scene = study_scene(scenes::find_scene("2-Cars"), options.overrides);
  const auto cases = make_cases({scene}, options);
  const Nature nature = find_nature(scene, options.nature);
  const RestRunner no_rest(scene, resting_settings(scene, options.nature), 0);
  OwnSolutions own(scene, nature, cases, options);
  EXPECT_EQ(own.ends(AccuracyCase::no_own), nullptr);
  std::map<int, double> error_by_iterations;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const AccuracyCase& one = cases[i];
    if (one.kind == CaseKind::setting) {
      const CaseResult result = run_case(one, scene, nature, no_rest, 1, own.ends(one.own));
      EXPECT_EQ(result.own_defect.body_position.count, scene.frames * nature.worlds[0]->num_bodies());
      error_by_iterations[one.stepper.iterations] = result.own_defect.body_position.rms;
      EXPECT_EQ(run_case(one, scene, nature, no_rest, 1).own_defect.body_position.count, 0);
    } else if (is_own(one.kind)) {
      const CaseResult result = own.judge(static_cast<int>(i));
      EXPECT_LT(result.own_defect.body_position.max, 1e-5)
          << case_kind_names[static_cast<std::size_t>(one.kind)];
      EXPECT_TRUE(result.solve_iterations == 640) << "one try, and another that settles";
      EXPECT_TRUE(std::isnan(result.rows));
    }
  }
  EXPECT_LT(error_by_iterations.at(60), error_by_iterations.at(2));
  EXPECT_GT(error_by_iterations.at(2), 1e-4);
}

TEST(OwnSolution, a_disturbance_moves_all_by_no_more_than_its_size) {
  const auto worlds =
      build_worlds(study_scene(scenes::find_scene("2-Cars"), options_of({}).overrides), 0.01, 1);
  const model::State start = model::initial_state(*worlds[0]);
  model::State moved = start, again = start, other = start;
  disturb(1e-12, 5, moved);
  disturb(1e-12, 5, again);
  disturb(1e-12, 6, other);
  EXPECT_EQ(model::hash(moved), model::hash(again));
  EXPECT_NE(model::hash(moved), model::hash(other));
  for (std::size_t body = 0; body < start.position.size(); ++body) {
    const double way = (moved.position[body] - start.position[body]).cwiseAbs().maxCoeff();
    EXPECT_GT(way, 0);
    EXPECT_LT(way, 1.1e-12);  // for coordinates up to 100 m, whose rounding is 1e-14 m
  }
}

TEST(RestRunner, counts_what_falls_though_a_short_step_holds_it) {
  const AccuracyOptions options = options_of({});
  const StudyScene scene = study_scene(scenes::find_scene("CrashSk"), options.overrides);
  const stepping::StepperSettings finer = resting_settings(scene, options.nature);
  const RestRunner rest(scene, finer, 1);
  EXPECT_EQ(rest.run(finer).fallen, 0) << "against itself";
  stepping::StepperSettings poor = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  poor.iterations = 1;
  const RestResult fallen = rest.run(poor);
  EXPECT_GT(fallen.fallen, 20) << "both humans sink, with most of their parts";
  EXPECT_LT(fallen.fell_at_s, 1);
  EXPECT_GT(fallen.creep_m_s, rest.run(finer).creep_m_s);
  EXPECT_TRUE(std::isnan(RestRunner(scene, finer, 0).run(poor).fallen)) << "nothing was watched";
}

}  // namespace
}  // namespace pbmpi::app
