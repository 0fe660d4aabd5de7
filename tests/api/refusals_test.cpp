/// Settings that a batch refuses, with messages that help.

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "pbmpi/batch.h"
#include "small_worlds.h"

namespace pbmpi::test {
namespace {

template <class Function>
void expect_refusal(Function&& function, const std::string& reason) {
  try {
    function();
    ADD_FAILURE() << "not refused; expected: " << reason;
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
  }
}

TEST(Refusals, of_options_name_what_is_wrong_and_the_nearest) {
  const auto with = [](const std::string& name, const std::string& value) {
    return [=] {
      BatchOptions options = small_options();
      options.settings = {{name, value}};
      Batch batch(options);
    };
  };
  expect_refusal(with("iteration", "3"), "did you mean 'iterations'");
  expect_refusal(with("iterations", "0"), "iterations 0");
  expect_refusal(with("dt", "soon"), "dt");
  expect_refusal(with("effects", "-fricton"), "did you mean 'friction'");
  expect_refusal(with("stepper", "slow"), "stepper");
  expect_refusal(
      [] {
        BatchOptions options = small_options();
        options.settings = {{"stepper", "quick"}, {"substeps", "3"}};
        Batch batch(options);
      },
      "substeps is an option of stepper sor");
}

TEST(Refusals, of_scenes_name_the_place) {
  expect_refusal([] { Batch batch(BatchOptions{}); }, "no scene");
  expect_refusal(
      [] {
        BatchOptions options;
        options.scene = "CrashSX";
        Batch batch(options);
      },
      "CrashSk");
  expect_refusal(
      [] {
        BatchOptions options = small_options();
        options.scene_text += "colour = 3\n";
        Batch batch(options);
      },
      "colour");
  expect_refusal([] { Batch batch(small_options(-1)); }, "num_worlds -1");
}

TEST(Refusals, of_worlds_with_other_bodies_name_the_world) {
  BatchOptions options = small_options();
  options.scene_text.replace(options.scene_text.find("copies = 2"), 10, "copies = [[0, 2], [3, 1]]");
  expect_refusal([&] { Batch batch(options); },
                 "world 3 has other bodies than world 0: 'door' in the place of 'ball.2'");
}

TEST(Refusals, of_parameters_name_the_world_and_the_key) {
  BatchOptions options = small_options(2);
  options.parameters = {{}, {{"bub.mass", "3"}}};
  expect_refusal([&] { Batch batch(options); }, "'bub.mass' of world 1");
  expect_refusal([&] { Batch batch(options); }, "'bob'");
  options.parameters.pop_back();
  expect_refusal([&] { Batch batch(options); }, "parameters of 1 worlds, and 2 worlds");
  Batch batch(small_options(2));
  const std::uint64_t before = batch.hash();
  expect_refusal([&] { batch.reset({}, 3, std::vector<Parameters>{{}, {{"bob.mass", "-1"}}}); }, "bob.mass");
  EXPECT_EQ(batch.hash(), before) << "a reset that is refused changes nothing";
}

TEST(Refusals, of_arrays_say_how_long_they_should_be) {
  Batch batch(small_options(2));
  const std::array<bool, 3> mask = {true, true, true};
  expect_refusal([&] { batch.reset(mask, 1); }, "3 entries");
  expect_refusal([&] { batch.set_state(batch.state(), mask); }, "3 entries");
  expect_refusal([&] { batch.step(-1); }, "-1 steps");
  expect_refusal([&] { batch.observable("energie"); }, "did you mean 'energy'");
  expect_refusal([&] { static_cast<void>(batch.hash(2)); }, "world 2");
  const std::vector<double> velocities(3, 0.0);
  expect_refusal([&] { batch.set_motor_velocities(velocities); }, "[2][1] motors");
  const std::vector<double> infinite(2, std::numeric_limits<double>::infinity());
  expect_refusal([&] { batch.set_motor_velocities(infinite); }, "infinite");
  BatchState state = batch.state();
  state.velocity.pop_back();
  expect_refusal([&] { batch.set_state(state); }, "velocity has 23 numbers, and [2][4][3] are 24");
}

TEST(Refusals, of_a_state_name_world_and_body_and_change_nothing) {
  Batch batch(small_options(2));
  const std::uint64_t before = batch.hash();
  BatchState state = batch.state();
  state.position[0] += 1;
  state.position[3 * 4 + 3 * 2] = std::numeric_limits<double>::quiet_NaN();
  expect_refusal([&] { batch.set_state(state); }, "position of body 'door' in world 1 is not finite");
  EXPECT_EQ(batch.hash(), before);
  state = batch.state();
  state.orientation[0] = 2;
  expect_refusal([&] { batch.set_state(state); }, "orientation of body 'ball.1' in world 0 has the length 2");
  EXPECT_EQ(batch.hash(), before);
}

TEST(Refusals, of_a_communicator_without_MPI) {
  BatchOptions options = small_options();
  options.communicator = 0;
  expect_refusal([&] { Batch batch(options); }, "MPI does not run");
}

}  // namespace
}  // namespace pbmpi::test
