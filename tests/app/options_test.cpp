#include "app/pbmpi/options/options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "app/pbmpi/options/run_options.h"
#include "core/error.h"
#include "fake_scene.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

std::string refusal(const std::vector<std::string>& args) {
  try {
    resolve(parse_options(args), FakeScene({}));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Options, absent_ones_come_from_the_scene) {
  const FakeScene scene({.replicas = 7,
                         .warmup = 1,
                         .frames = 9,
                         .steps_per_frame = 2,
                         .dt_s = 0.004,
                         .iterations = 33,
                         .effects = {}});
  const RunSpec spec = resolve(parse_options({"--scene", "Fake"}), scene);
  EXPECT_EQ(spec.num_worlds, 7);
  EXPECT_EQ(spec.total_frames(), 10);
  EXPECT_EQ(spec.steps_per_frame, 2);
  EXPECT_EQ(spec.stepper.dt_s, 0.004);
  EXPECT_EQ(spec.stepper.iterations, 1) << "the scene's are quick's";
  EXPECT_EQ(spec.output, "Fake.h5");
  EXPECT_EQ(resolve(parse_options({"--scene", "Fake", "--stepper", "quick"}), scene).stepper.iterations, 33);
}

TEST(Options, the_output_of_a_hard_case_lies_in_the_current_folder) {
  const FakeScene scene({}, "hard/rest/column20");
  EXPECT_EQ(resolve(parse_options({"--scene", "hard/rest/column20"}), scene).output, "column20.h5");
}

TEST(Options, given_ones_win_over_the_scene) {
  const RunSpec spec =
      resolve(parse_options({"--scene", "Fake", "--replicas", "3", "--dt", "0.002", "--iterations=5",
                             "--stepper", "direct", "--seed", "18446744073709551615", "--no-output"}),
              FakeScene({}));
  EXPECT_EQ(spec.num_worlds, 3);
  EXPECT_EQ(spec.stepper.dt_s, 0.002);
  EXPECT_EQ(spec.stepper.iterations, 5);
  EXPECT_EQ(spec.stepper.kind, stepping::StepperKind::direct);
  EXPECT_EQ(spec.stepper.seed, 18446744073709551615ull);
  EXPECT_FALSE(spec.output.has_value());
}

TEST(Options, impossible_values_are_named) {
  EXPECT_NE(refusal({"--scene", "Fake", "--dt", "-1"}).find("--dt"), std::string::npos);
  EXPECT_NE(refusal({"--scene", "Fake", "--dt", "nan"}).find("--dt"), std::string::npos);
  EXPECT_NE(refusal({"--scene", "Fake", "--frames", "0"}).find("--frames"), std::string::npos);
  EXPECT_NE(refusal({"--scene", "Fake", "--replicas", "0"}).find("--replicas"), std::string::npos);
  EXPECT_NE(refusal({"--scene", "Fake", "--warmup", "-1"}).find("--warmup"), std::string::npos);
  EXPECT_NE(refusal({"--scene", "Fake", "--frames", "many"}).find("many"), std::string::npos);
  EXPECT_NE(refusal({}).find("--scene"), std::string::npos);
  EXPECT_EQ(refusal({"--scene", "Fake"}), "");
}

TEST(Options, those_of_sor_are_refused_with_another_stepper) {
  EXPECT_NE(refusal({"--scene", "Fake", "--stepper", "quick", "--substeps", "2"}).find("--stepper sor"),
            std::string::npos);
  EXPECT_NE(refusal({"--scene", "Fake", "--stepper", "quick", "--precision", "single"}).find("--stepper sor"),
            std::string::npos);
  EXPECT_EQ(refusal({"--scene", "Fake", "--stepper", "sor", "--substeps", "2", "--precision", "single"}), "");
  EXPECT_NE(refusal({"--scene", "Fake", "--stepper", "sor", "--substeps", "0"}).find("at least 1"),
            std::string::npos);
  EXPECT_NE(refusal({"--scene", "Fake", "--stepper", "quick", "--law", "soft"}).find("--stepper sor"),
            std::string::npos);
  EXPECT_NE(refusal({"--scene", "Fake", "--stepper", "quick", "--record", "residuals"}).find("--stepper sor"),
            std::string::npos);
}

TEST(Options, parts_of_a_law_cannot_be_chosen) {
  for (const char* part : {"--sor-factor", "--warm-start", "--relax", "--contact-frequency", "--joint-solver",
                           "--friction", "--row-order", "--colliders"})
    EXPECT_NE(refusal({"--scene", "Fake", part, "1"}).find("unknown option"), std::string::npos) << part;
  EXPECT_NE(
      refusal({"--scene", "Fake", "--law", "hard"}).find("--law hard: it must be one of soft, ode, coulomb"),
      std::string::npos);
}

TEST(Options, sor_starts_with_the_step_that_has_a_memory) {
  const auto step = [](const std::vector<std::string>& args) {
    return resolve(parse_options(args), FakeScene({})).stepper;
  };
  const stepping::StepperSettings sor = step({"--scene", "Fake"}),
                                  quick = step({"--scene", "Fake", "--stepper", "quick"});
  for (const stepping::StepOption& option : stepping::step_options()) {
    EXPECT_TRUE(is_default(option, sor)) << option.name;
    EXPECT_TRUE(is_default(option, quick)) << option.name;
  }
  EXPECT_EQ(sor.substeps, 14);
  EXPECT_EQ(sor.law.warm_start, 1);
  EXPECT_EQ(quick.substeps, 1);
}

TEST(Options, residuals_are_of_whole_worlds_and_go_into_the_file) {
  const auto spec = [](std::vector<std::string> more) {
    std::vector<std::string> args = {"--scene", "Fake", "--stepper", "sor", "--record", "residuals"};
    args.insert(args.end(), more.begin(), more.end());
    return resolve(parse_options(args), FakeScene({}));
  };
  EXPECT_TRUE(spec({}).stepper.residuals);
  const std::vector<double> costs = {1, 1, 1};
  EXPECT_EQ(decompose(spec({"--replicas", "1"}), costs, 2).decomposition, Decomposition::worlds);
  EXPECT_THROW(decompose(spec({"--replicas", "1", "--decompose", "spaces"}), costs, 2), core::InputError);
  EXPECT_THROW(spec({"--no-output"}), core::InputError);
}

TEST(Options, feec_estimates_as_the_precise_stepper_does_but_with_one_iteration) {
  const RunSpec spec =
      resolve(parse_options({"--scene", "Fake", "--feec", "--solver-seed", "7"}), FakeScene({}));
  ASSERT_TRUE(spec.estimate.has_value());
  EXPECT_EQ(spec.estimate->kind, stepping::StepperKind::sor);
  EXPECT_EQ(spec.estimate->iterations, 1);
  EXPECT_EQ(spec.estimate->seed, 7u);
  EXPECT_EQ(spec.stepper.seed, 7u);
  EXPECT_EQ(spec.seed, 1u);
  EXPECT_FALSE(resolve(parse_options({"--scene", "Fake"}), FakeScene({})).estimate.has_value());
}

TEST(Options, feec_may_estimate_with_another_stepper) {
  const RunSpec spec = resolve(
      parse_options({"--scene", "Fake", "--stepper", "quick", "--feec=sor iterations=3 precision=single"}),
      FakeScene({}));
  ASSERT_TRUE(spec.estimate.has_value());
  EXPECT_EQ(spec.stepper.kind, stepping::StepperKind::quick);
  EXPECT_EQ(spec.estimate->kind, stepping::StepperKind::sor);
  EXPECT_EQ(spec.estimate->iterations, 3);
  EXPECT_EQ(spec.estimate->precision, stepping::Precision::single);
}

TEST(Options, an_estimate_that_cannot_be_is_refused_by_name) {
  const auto refused = [](const std::string& setting, const char* stepper = "sor") {
    return refusal({"--scene", "Fake", "--stepper", stepper, "--feec=" + setting});
  };
  EXPECT_EQ(refused("iterations=2"), "");
  EXPECT_EQ(refused("iterations=0"), "--feec='iterations=0': iterations 0: it must be at least 1");
  EXPECT_NE(refused("fast").find("quick, direct, sor"), std::string::npos);
  EXPECT_NE(refused("precision=single", "quick").find("the stepper quick has no such option"),
            std::string::npos);
  EXPECT_NE(refused("substeps=2").find("substeps: an estimate has a stepper, iterations and a precision"),
            std::string::npos);
  EXPECT_NE(refused("sor single").find("STEPPER iterations=N precision=NAME"), std::string::npos);
  EXPECT_EQ(refused("iterations=2 iterations=3"),
            "--feec='iterations=2 iterations=3': iterations stands there twice");
  EXPECT_NE(refusal({"--scene", "Fake", "--feec", "sor", "iterations=3"}).find("stands alone"),
            std::string::npos)
      << "the words of a setting are one word of the command line";
  EXPECT_NE(refusal({"--scene", "Fake", "--solver-seed", "-x"}).find("solver-seed"), std::string::npos);
}

TEST(Options, a_slip_of_the_pen_gets_a_suggestion) {
  EXPECT_NE(refusal({"--scene", "Fake", "--itertions", "4"}).find("did you mean --iterations?"),
            std::string::npos);
  EXPECT_NE(refusal({"--scene", "Fake", "stray"}).find("stands alone"), std::string::npos);
}

TEST(Options, a_frame_may_take_a_tenth_of_one_at_30_Hz_unless_told_otherwise) {
  const auto budget_s = [](const std::vector<std::string>& more) {
    std::vector<std::string> args = {"--scene", "Fake"};
    args.insert(args.end(), more.begin(), more.end());
    return resolve(parse_options(args), FakeScene({})).budget_s;
  };
  EXPECT_EQ(budget_s({}), 0.1 / 30);
  EXPECT_EQ(budget_s({"--budget", "0.002"}), 0.002);
  EXPECT_EQ(budget_s({"--budget", "2ms"}), 0.002);
  EXPECT_NE(
      refusal({"--scene", "Fake", "--budget", "0"}).find("--budget 0: it must be a finite number above 0"),
      std::string::npos);
}

TEST(RunOptions, stand_in_the_file_unless_they_change_neither_it_nor_a_result) {
  // The scene, its table of parameters and what is recorded have entries of their own; the others say where a
  // run writes, what it prints, and when it stops.
  const std::set<std::string_view> others = {"scene",   "parameters",       "output",   "no-output",
                                             "no-xdmf", "report",           "max-time", "checkpoint",
                                             "resume",  "checkpoint-every", "record"};
  std::set<std::string_view> left_out;
  for (const RunOption& option : run_options()) {
    if (!option.recorded) left_out.insert(option.name);
  }
  EXPECT_EQ(left_out, others);
}

TEST(RunOptions, have_values_that_are_read_back) {
  const std::map<std::string_view, std::string> texts = {{"world-range", "3:7"},
                                                         {"effects", "+drag,-friction"},
                                                         {"on-blowup", "freeze"},
                                                         {"budget", "0.002"},
                                                         {"seed", "18446744073709551615"}};
  for (const RunOption& option : run_options()) {
    const auto text = texts.find(option.name);
    if (text == texts.end()) continue;
    RunSpec spec;
    set(option, text->second, spec);
    EXPECT_EQ(text_of(option, spec), text->second) << option.name;
  }
}

TEST(Options, help_names_every_group_and_exit_code) {
  const std::string help = help_of(pbmpi_manual(), {"--help", "all"});
  for (const char* words :
       {"What to simulate", "How to step", "How to cut the work", "What to write", "General", "75"}) {
    EXPECT_NE(help.find(words), std::string::npos) << words;
  }
}

/// The cut of worlds whose spaces cost the same.
Cut cut(const std::vector<std::string>& args, int num_spaces, int num_ranks) {
  const std::vector<double> costs(static_cast<std::size_t>(num_spaces), 1);
  return decompose(resolve(parse_options(args), FakeScene({})), costs, num_ranks);
}

Decomposition decided(const std::vector<std::string>& args, int num_spaces, int num_ranks) {
  return cut(args, num_spaces, num_ranks).decomposition;
}

TEST(Options, cut_into_spaces_by_themselves_only_where_it_helps) {
  const std::vector<std::string> sor = {"--scene", "Fake", "--stepper", "sor"};
  EXPECT_EQ(decided(sor, 3, 2), Decomposition::spaces);
  EXPECT_EQ(decided(sor, 1, 2), Decomposition::worlds);
  EXPECT_EQ(decided(sor, 3, 1), Decomposition::worlds);
  EXPECT_EQ(decided({"--scene", "Fake"}, 3, 2), Decomposition::spaces) << "sor is the default stepper";
  EXPECT_EQ(decided({"--scene", "Fake", "--stepper", "quick"}, 3, 2), Decomposition::worlds);
  EXPECT_EQ(decided({"--scene", "Fake", "--feec"}, 3, 2), Decomposition::spaces);
  const std::vector<std::string> threads = {"--scene", "Fake", "--replicas", "1", "--threads", "2"};
  EXPECT_THROW(decided(threads, 3, 2), core::InputError) << "threads step worlds of their own";
  EXPECT_EQ(decided(threads, 3, 1), Decomposition::worlds);
  EXPECT_EQ(decided({"--scene", "Fake", "--stepper", "sor", "--replicas", "2"}, 3, 2), Decomposition::worlds);
}

TEST(Options, cut_many_worlds_by_themselves_only_where_ranks_would_have_none_and_groups_are_faster) {
  const std::vector<std::string> three = {"--scene", "Fake", "--replicas", "3"};
  EXPECT_EQ(decided(three, 4, 3), Decomposition::worlds) << "each rank has a world";
  EXPECT_EQ(decided(three, 1, 6), Decomposition::worlds) << "there is nothing to cut at";
  const Cut six = cut(three, 4, 6);
  EXPECT_EQ(six.decomposition, Decomposition::spaces);
  EXPECT_EQ(six.groups.ranks, (std::vector<int>{2, 2, 2}));
  EXPECT_EQ(six.groups.worlds, (std::vector<int>{1, 1, 1}));
  const std::vector<std::string> threads = {"--scene", "Fake", "--replicas", "3", "--threads", "2"};
  EXPECT_EQ(decided(threads, 4, 6), Decomposition::worlds) << "as without groups";
  EXPECT_EQ(decided({"--scene", "Fake", "--replicas", "3", "--stepper", "quick"}, 4, 6),
            Decomposition::worlds);
}

TEST(Options, cut_worlds_over_as_many_ranks_as_they_are_told) {
  const auto ranks_of = [](const std::vector<std::string>& more, int num_ranks) {
    std::vector<std::string> args = {"--scene", "Fake"};
    args.insert(args.end(), more.begin(), more.end());
    return cut(args, 4, num_ranks).groups.ranks;
  };
  EXPECT_EQ(ranks_of({"--replicas", "5", "--ranks-per-world", "2"}, 5), (std::vector<int>{2, 2, 1}));
  EXPECT_EQ(ranks_of({"--replicas", "5", "--decompose", "spaces", "--ranks-per-world", "9"}, 4),
            (std::vector<int>{4}));
  EXPECT_EQ(ranks_of({"--replicas", "1", "--ranks-per-world", "2"}, 4), (std::vector<int>{2}));
  EXPECT_EQ(ranks_of({"--replicas", "1", "--decompose", "spaces"}, 4), (std::vector<int>{4}));
  EXPECT_EQ(ranks_of({"--replicas", "3", "--decompose", "spaces"}, 4), (std::vector<int>{4}))
      << "three times a quarter of a world is the least";
}

TEST(Options, cut_as_they_are_told) {
  const std::vector<std::string> worlds = {"--scene", "Fake", "--stepper", "sor", "--decompose", "worlds"};
  const std::vector<std::string> spaces = {"--scene", "Fake", "--stepper", "sor", "--decompose", "spaces"};
  EXPECT_EQ(decided(worlds, 3, 2), Decomposition::worlds);
  EXPECT_EQ(decided(spaces, 1, 1), Decomposition::spaces);
}

TEST(Options, refuse_spaces_where_they_cannot_be_had_and_say_why) {
  const auto refused = [](std::vector<std::string> more) {
    std::vector<std::string> args = {"--scene", "Fake", "--decompose", "spaces"};
    args.insert(args.end(), more.begin(), more.end());
    try {
      decided(args, 3, 2);
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const char* stepper : {"quick", "direct"})
    EXPECT_NE(refused({"--stepper", stepper}).find("add --stepper sor"), std::string::npos);
  EXPECT_EQ(refused({"--stepper", "sor", "--replicas", "4"}), "");
  EXPECT_NE(refused({"--ranks-per-world", "0"}).find("at least 1"), std::string::npos);
}

TEST(Options, refuse_ranks_for_worlds_that_are_to_stay_whole) {
  const std::vector<std::string> args = {"--scene",           "Fake", "--decompose", "worlds",
                                         "--ranks-per-world", "2"};
  try {
    decided(args, 3, 2);
    ADD_FAILURE() << "they exclude each other";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("leave it out, or give --decompose spaces"), std::string::npos);
  }
}

TEST(Options, ask_about_a_number_without_a_unit_that_is_probably_meant_in_another) {
  for (const char* option : {"--budget", "--tolerance", "--dt"}) {
    const std::string message = refusal({"--scene", "Fake", option, "3.33"});
    EXPECT_NE(message.find(std::string(option) + " 3.33: is that 3.33"), std::string::npos) << message;
  }
  const Options options =
      parse_options({"--scene", "Fake", "--dt", "5ms", "--max-time", "1h", "--checkpoint-every", "10min",
                     "--budget", "2ms", "--tolerance", "1cm"});
  EXPECT_EQ(options.dt_s(), 0.005);
  EXPECT_EQ(options.run.max_time_s, 3600);
  EXPECT_EQ(options.run.checkpoint_every_s, 600);
  EXPECT_EQ(options.run.budget_s, 0.002);
  EXPECT_EQ(options.step.settings.tolerance_m, 0.01);
}

TEST(Options, record_what_a_list_names) {
  const Options options = parse_options({"--scene", "Fake", "--record", "residuals,contacts"});
  EXPECT_EQ(to_text(options.run.records), "contacts,residuals");
  EXPECT_FALSE(options.run.records.has(Record::islands));
  EXPECT_EQ(refusal({"--scene", "Fake", "--record", "forces"}),
            "--record forces: it must be one of islands, contacts, residuals");
}

TEST(Options, name_a_word_that_stands_alone) {
  EXPECT_EQ(refusal({"CrashSk"}),
            "the word 'CrashSk' stands alone on the command line; did you mean --scene CrashSk?");
}

}  // namespace
}  // namespace pbmpi::app
