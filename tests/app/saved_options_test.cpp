#include "app/pbmpi/options/options.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "fake_scene.h"

namespace pbmpi::app {
namespace {

RunSpec resolved(const std::vector<std::string>& args, const std::string& saved = "",
                 const ResumePoint& from = {}) {
  return resolve(parse_options(args, saved), FakeScene({}), from);
}

std::string saved(const std::vector<std::string>& args) { return saved_options(resolved(args)); }

std::string refusal(const std::vector<std::string>& args, const std::string& before) {
  try {
    require_same_stepper("ck.h5", before, parse_options(args, before).step.settings.kind);
    require_same_physics("ck.h5", before, saved_options(resolved(args, before)));
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SavedOptions, give_the_same_run_when_they_are_read_again) {
  const std::vector<std::vector<std::string>> runs = {
      {"--scene", "Fake"},
      {"--scene", "Fake", "--stepper", "quick", "--dt", "0.1", "--replicas", "7"},
      {"--scene", "Fake", "--substeps", "4", "--law", "coulomb", "--precision", "single", "--simd", "sse2",
       "--decompose", "worlds"},
      {"--scene", "Fake", "--seed", "18446744073709551615", "--solver-seed", "3", "--record-every", "5",
       "--budget", "2ms"},
      {"--scene", "Fake", "--feec=quick iterations=3"},
      {"--scene", "Fake", "--feec=precision=single", "--dt", "0.012345678901234567"}};
  for (const auto& args : runs) {
    const std::string first = saved(args);
    EXPECT_EQ(saved_options(resolved({"--scene", "Fake"}, first)), first);
    EXPECT_EQ(refusal({"--scene", "Fake"}, first), "");
    EXPECT_EQ(refusal(args, first), "") << "the same options may be given again";
  }
}

TEST(SavedOptions, keep_every_bit_of_a_real_number) {
  const double dt_s = 0.1 + 0.2;  // 0.30000000000000004
  RunSpec spec = resolved({"--scene", "Fake"});
  spec.stepper.dt_s = dt_s;
  EXPECT_EQ(parse_options({"--scene", "Fake"}, saved_options(spec)).dt_s(), dt_s);
}

TEST(SavedOptions, each_that_decides_the_bits_is_refused_if_it_changes) {
  const std::string before = saved({"--scene", "Fake", "--substeps", "2"});
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"stepper", "quick"}, {"precision", "single"}, {"replicas", "9"},   {"dt", "0.5"},
      {"seed", "2"},        {"substeps", "3"},       {"iterations", "7"}, {"steps-per-frame", "9"},
      {"law", "ode"},       {"solver-seed", "5"}};
  for (const auto& [name, value] : changes) {
    const std::string message = refusal({"--" + name, value, "--scene", "Fake"}, before);
    EXPECT_TRUE(message.starts_with("--" + name + " " + value + ": the run in ck.h5 has " + name)) << message;
  }
}

TEST(SavedOptions, that_are_gone_are_refused_by_name) {
  try {
    resolved({"--scene", "Fake"}, "finish = none\n");
    FAIL() << "nothing was refused";
  } catch (const core::InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("the options in the checkpoint: unknown option 'finish'"), 0u)
        << error.what();
  }
}

TEST(SavedOptions, others_may_change) {
  const std::string before = saved({"--scene", "Fake"});
  EXPECT_EQ(refusal({"--scene", "Fake", "--frames", "99", "--warmup", "0", "--record-every", "2", "--simd",
                     "off", "--threads", "4", "--decompose", "worlds", "--feec", "--budget", "1ms"},
                    before),
            "");
}

TEST(Resume, output_goes_to_a_file_of_its_own_beside_the_first) {
  const auto output = [](const ResumePoint& from, std::vector<std::string> args = {}) {
    args.insert(args.end(), {"--scene", "Fake", "--frames", "100"});
    return resolved(args, "", from).output;
  };
  EXPECT_EQ(output({"ck.h5", 8, "/data/run.h5"}), "/data/run.from8.h5");
  EXPECT_EQ(output({"ck.h5", 12, "/data/run.from8.h5"}), "/data/run.from12.h5");
  EXPECT_EQ(output({"ck.h5", 12, (std::filesystem::current_path() / "a.h5").string()}), "a.from12.h5");
  EXPECT_EQ(output({"ck.h5", 12, ""}), std::nullopt) << "the first run had none";
  EXPECT_EQ(output({"ck.h5", 12, ""}, {"--output", "b.h5"}), "b.h5");
  EXPECT_THROW(output({"ck.h5", 12, "/data/run.h5"}, {"--output", "/data/../data/run.h5"}), core::InputError);
  EXPECT_THROW(output({"ck.h5", 12, "/data/run.h5"}, {"--output", "ck.h5"}), core::InputError);
}

TEST(Resume, checkpoints_go_on_in_the_same_file) {
  EXPECT_EQ(resolved({"--scene", "Fake"}).checkpoint.path, "Fake.checkpoint.h5");
  EXPECT_EQ(resolved({"--scene", "Fake", "--output", "x/run.h5"}).checkpoint.path, "x/run.checkpoint.h5");
  EXPECT_EQ(resolved({"--resume", "ck.h5", "--frames", "9"}, "", {"ck.h5", 8, "a.h5"}).checkpoint.path,
            "ck.h5");
  EXPECT_EQ(resolved({"--resume", "ck.h5", "--checkpoint", "b.h5"}, "", {"ck.h5", 7, "a.h5"}).checkpoint.path,
            "b.h5");
  EXPECT_FALSE(resolved({"--scene", "Fake"}).checkpoint_file.has_value());
  EXPECT_TRUE(resolved({"--scene", "Fake", "--checkpoint", "b.h5"}).checkpoint_file.has_value());
}

}  // namespace
}  // namespace pbmpi::app
