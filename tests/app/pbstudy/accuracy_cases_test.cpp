#include "app/pbstudy/accuracy/accuracy_cases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "app/pbstudy/accuracy/case_runner.h"
#include "app/pbstudy/accuracy/own_solution.h"
#include "app/pbstudy/accuracy/yardsticks.h"
#include "core/error.h"
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
  // one; each with the scene's step and half of it
  EXPECT_EQ(count(cases, CaseKind::setting), 2 * (2 + 1 + 4 + 2));
}

TEST(AccuracyCases, one_law_may_be_studied_alone) {
  const auto cases_with = [](const char* law) {
    return cases_of(options_of({"--stepper", "sor", "--law", law, "--iterations", "3", "--substeps", "1", "5",
                                "--precision", "double", "--dt", "0.01"}));
  };
  for (const AccuracyCase& one : cases_with("ode")) EXPECT_EQ(one.stepper.law, stepping::ode_law());
  EXPECT_EQ(count(cases_with("ode"), CaseKind::setting), 2);
  for (const AccuracyCase& one : cases_with("soft")) {
    const bool is_reference = is_yardstick(one.kind);
    EXPECT_EQ(one.stepper.law.name, is_reference ? stepping::Law::ode : stepping::Law::soft);
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

TEST(AccuracyCases, the_yardsticks_are_other_seeds_more_iterations_another_method_and_half_the_step) {
  const auto cases =
      cases_of(options_of({"--floor-seeds", "9", "--reference-iterations", "50", "--reference-check", "7"}));
  EXPECT_EQ(count(cases, CaseKind::floor), 9);
  std::set<std::uint64_t> seeds;
  for (const AccuracyCase& one : cases) {
    if (one.kind == CaseKind::floor) seeds.insert(one.stepper.seed);
    if (one.kind == CaseKind::more_iterations) {
      EXPECT_EQ(one.sweeps(), 7 * 50);
    }
    if (one.kind == CaseKind::second_method) {
      EXPECT_EQ(one.stepper.kind, stepping::StepperKind::direct) << "37 bodies are few";
    }
    if (one.kind == CaseKind::halved_dt) {
      EXPECT_EQ(one.stepper.dt_s * one.steps_per_frame, 0.03);
    }
  }
  EXPECT_EQ(seeds.size(), 9u);
  EXPECT_FALSE(seeds.contains(1)) << "that of the reference itself";
  for (const CaseKind kind :
       {CaseKind::reference, CaseKind::more_iterations, CaseKind::second_method, CaseKind::halved_dt})
    EXPECT_EQ(count(cases, kind), 1);
  const auto unchecked = cases_of(options_of({"--reference-check", "0"}));
  EXPECT_EQ(count(unchecked, CaseKind::more_iterations) + count(unchecked, CaseKind::second_method), 0);
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
  EXPECT_NE(refusal({"--reference-iterations", "1"}).find("--reference-iterations"), std::string::npos);
  EXPECT_NE(refusal({"--max-sweeps", "0"}).find("--max-sweeps"), std::string::npos);
  EXPECT_NE(refusal({"--reference-residual", "1"}).find("--reference-residual"), std::string::npos)
      << "1 what?";
  EXPECT_NE(refusal({"--reference-most-iterations", "639"}).find("at least 640"), std::string::npos);
  EXPECT_NE(refusal({"--own-iterations", "-1"}).find("--own-iterations"), std::string::npos);
  EXPECT_NE(refusal({"--own-most-iterations", "2559"}).find("at least 2560"), std::string::npos);
  EXPECT_NE(refusal({"--reference-check", "-1"}).find("--reference-check"), std::string::npos);
  EXPECT_NE(refusal({"--replicas", "0"}).find("--replicas"), std::string::npos);
  EXPECT_NE(refusal({"--warmup", "-1"}).find("--warmup"), std::string::npos);
  EXPECT_NE(refusal({"--frames", "0"}).find("--frames"), std::string::npos);
}

TEST(CaseRunner, the_reference_has_no_error_against_itself_and_few_iterations_have) {
  const AccuracyOptions options = options_of({"--reference-iterations", "40", "--reference-residual", "0"});
  const StudyScene scene = study_scene(scenes::find_scene("CrashSk"), options.overrides);
  const SolvedReference reference = solve_reference(scene, reference_solve(scene, options));
  const RestRunner no_rest(scene, reference_settings(scene, options), 0);
  ASSERT_EQ(reference.states.size(), 9u);
  AccuracyCase one{0, CaseKind::setting, reference_settings(scene, options), 3};
  const CaseResult itself = run_case(one, scene, reference, no_rest, 2);
  EXPECT_EQ(itself.defect.body_position.max, 0);
  EXPECT_EQ(itself.drift.body_position.max, 0);
  EXPECT_EQ(itself.energy_change_j, 0);
  EXPECT_EQ(itself.momentum_change_ns, 0);
  EXPECT_EQ(itself.defect.body_position.count, 5 * 37);
  EXPECT_EQ(itself.defect.joint_position.count, 5 * 34);
  EXPECT_DOUBLE_EQ(itself.row_visits, itself.rows * 40 * 3);

  one.stepper.iterations = 2;
  const CaseResult few = run_case(one, scene, reference, no_rest, 1);
  EXPECT_GT(few.defect.body_position.max, 1e-3) << "two iterations are seen in a crash";
  EXPECT_GE(few.drift.body_position.rms, few.defect.body_position.rms)
      << "a frame's error grows along the way";
  EXPECT_EQ(few.defect.body_position.count, itself.defect.body_position.count);
}

TEST(CaseRunner, repeats_change_times_only) {
  const AccuracyOptions options = options_of({"--reference-iterations", "10", "--reference-residual", "0"});
  const StudyScene scene = study_scene(scenes::find_scene("CrashSk"), options.overrides);
  const SolvedReference reference = solve_reference(scene, reference_solve(scene, options));
  const RestRunner no_rest(scene, reference_settings(scene, options), 0);
  AccuracyCase one{0, CaseKind::setting, default_settings(stepping::StepperKind::quick), 3};
  one.stepper.iterations = 5;
  const CaseResult once = run_case(one, scene, reference, no_rest, 1);
  const CaseResult thrice = run_case(one, scene, reference, no_rest, 3);
  EXPECT_EQ(once.defect.body_position.rms, thrice.defect.body_position.rms);
  EXPECT_EQ(once.max_joint_gap_m, thrice.max_joint_gap_m);
}

TEST(ConvergingStepper, solves_each_step_of_each_world_as_far_as_asked) {
  const AccuracyOptions options =
      options_of({"--replicas", "3", "--reference-iterations", "40", "--reference-residual", "1mm",
                  "--reference-most-iterations", "2560"});
  const StudyScene scene = study_scene(scenes::find_scene("CrashSk"), options.overrides);
  ReferenceSolve asked = reference_solve(scene, options);
  const SolvedReference reference = solve_reference(scene, asked);
  std::set<int> used;
  for (const std::vector<int>& step : reference.iterations) used.insert(step.begin(), step.end());
  EXPECT_GT(used.size(), 1u) << "a crash asks for more than a car on its wheels";
  for (const int iterations : used)
    EXPECT_TRUE((std::set<int>{40, 160, 640, 2560}.contains(iterations))) << iterations;
  EXPECT_TRUE(reference.account.residual <= 1e-3 || used.contains(2560));

  // World 1 converges in the same way on its own.
  ConvergingStepper stepper({reference.worlds[1]}, asked);
  for (const std::vector<int>& step : reference.iterations) {
    stepper.advance();
    EXPECT_EQ(stepper.iterations().front(), step[1]);
  }
  EXPECT_EQ(model::hash(stepper.states().front()), model::hash(reference.states.back()[1]));

  asked.residual = 0;
  const SolvedReference once = solve_reference(scene, asked);
  EXPECT_EQ(once.account.most_iterations, 40);
  EXPECT_GT(once.account.residual, reference.account.residual) << "more iterations leave less";
}

TEST(Yardsticks, the_reference_solved_further_is_nearer_to_it_than_half_of_it) {
  const AccuracyOptions options =
      options_of({"--reference-iterations", "320", "--reference-residual", "0", "--reference-check", "8"});
  const StudyScene scene = study_scene(scenes::find_scene("CrashSk"), options.overrides);
  const SolvedReference reference = solve_reference(scene, reference_solve(scene, options));
  const auto defect = [&](CaseKind kind) {
    for (const AccuracyCase& one : make_cases({scene}, options)) {
      if (one.kind == kind) return run_yardstick(one, scene, reference, options).defect.body_position;
    }
    return analysis::ErrorSummary();
  };
  EXPECT_EQ(defect(CaseKind::reference).max, 0);
  EXPECT_EQ(defect(CaseKind::reference).count, 5 * 37);
  const double further = defect(CaseKind::more_iterations).rms;
  EXPECT_GT(further, 0);
  const RestRunner no_rest(scene, reference_settings(scene, options), 0);
  AccuracyCase few{0, CaseKind::setting, reference_settings(scene, options), 3};
  few.stepper.iterations = 20;
  EXPECT_LT(further, run_case(few, scene, reference, no_rest, 1).defect.body_position.rms);
  EXPECT_GT(defect(CaseKind::second_method).rms, 0) << "ODE has other contact points";
  EXPECT_GT(defect(CaseKind::halved_dt).rms, further) << "the step is long";
}

/// The settings, own solutions and noise floors of these options.
std::vector<AccuracyCase> own_cases_of(const std::vector<std::string>& args) {
  const auto cases = cases_of(options_of(args));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const bool has_own = cases[i].kind == CaseKind::setting || is_own(cases[i].kind);
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
  // At two step lengths: quick, direct, and sor with both laws in one and in 14 substeps.
  EXPECT_EQ(count(cases, CaseKind::own), 2 * (1 + 1 + 2 * 2));
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
                                              "--reference-iterations",
                                              "40",
                                              "--reference-residual",
                                              "0.01mm",
                                              "--reference-most-iterations",
                                              "640",
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
  const SolvedReference reference = solve_reference(scene, reference_solve(scene, options));
  const RestRunner no_rest(scene, reference_settings(scene, options), 0);
  OwnSolutions own(scene, reference, cases, options);
  EXPECT_EQ(own.ends(AccuracyCase::no_own), nullptr);
  std::map<int, double> error_by_iterations;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const AccuracyCase& one = cases[i];
    if (one.kind == CaseKind::setting) {
      const CaseResult result = run_case(one, scene, reference, no_rest, 1, own.ends(one.own));
      EXPECT_EQ(result.own_defect.body_position.count, result.defect.body_position.count);
      error_by_iterations[one.stepper.iterations] = result.own_defect.body_position.rms;
      EXPECT_EQ(run_case(one, scene, reference, no_rest, 1).own_defect.body_position.count, 0);
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

TEST(RestRunner, counts_what_falls_though_the_reference_holds_it) {
  const AccuracyOptions options = options_of({"--reference-iterations", "80"});
  const StudyScene scene = study_scene(scenes::find_scene("CrashSk"), options.overrides);
  const stepping::StepperSettings reference = reference_settings(scene, options);
  const RestRunner rest(scene, reference, 1);
  EXPECT_EQ(rest.run(reference).fallen, 0) << "against itself";
  stepping::StepperSettings poor = reference;
  poor.iterations = 1;
  const RestResult fallen = rest.run(poor);
  EXPECT_GT(fallen.fallen, 20) << "both humans sink, with most of their parts";
  EXPECT_LT(fallen.fell_at_s, 1);
  EXPECT_GT(fallen.creep_m_s, rest.run(reference).creep_m_s);
  EXPECT_TRUE(std::isnan(RestRunner(scene, reference, 0).run(poor).fallen)) << "nothing was watched";
}

}  // namespace
}  // namespace pbmpi::app
