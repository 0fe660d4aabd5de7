/// What a batch guarantees of its worlds' bits, without MPI.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pbmpi/batch.h"
#include "small_worlds.h"

namespace pbmpi::test {
namespace {

std::vector<std::uint64_t> hashes(const Batch& batch) {
  std::vector<std::uint64_t> all;
  for (const int world : batch.world_ids()) all.push_back(batch.hash(world));
  return all;
}

/// A batch after so many steps.
Batch stepped(const BatchOptions& options, int num_steps) {
  Batch batch(options);
  batch.step(num_steps);
  return batch;
}

TEST(Batch, knows_its_worlds_and_bodies) {
  const Batch batch(small_options(0));
  EXPECT_EQ(batch.num_worlds(), 3) << "as many as the scene says";
  EXPECT_EQ(batch.num_local_worlds(), 3);
  EXPECT_EQ(std::vector(batch.world_ids().begin(), batch.world_ids().end()), (std::vector{0, 1, 2}));
  EXPECT_EQ(std::vector(batch.body_names().begin(), batch.body_names().end()),
            (std::vector<std::string>{"ball.1", "ball.2", "door", "bob"}));
  EXPECT_EQ(batch.num_bodies(), 4);
  EXPECT_EQ(batch.dt_s(), 0.01);
  EXPECT_EQ(batch.steps_per_frame(), 3);
  ASSERT_EQ(batch.motors().size(), 1u);
  EXPECT_EQ(batch.motors()[0].name, "hinge");
  EXPECT_EQ(batch.motors()[0].max_force, 1000);
}

TEST(Batch, seed_and_settings_decide_its_bits) {
  const auto reference = hashes(stepped(small_options(), 40));
  EXPECT_EQ(hashes(stepped(small_options(), 40)), reference);
  EXPECT_NE(hashes(stepped(small_options(5, 2), 40)), reference);
  BatchOptions options = small_options();
  options.settings = {{"law", "ode"}, {"substeps", "4"}};
  EXPECT_NE(hashes(stepped(options, 40)), reference);
  options.settings = {{"effects", "-gravity"}};
  EXPECT_NE(hashes(stepped(options, 40)), reference);
}

TEST(Batch, a_world_does_not_depend_on_its_neighbours_nor_on_how_steps_are_asked_for) {
  const auto of_five = hashes(stepped(small_options(5), 30));
  Batch batch(small_options(2));
  for (int step = 0; step < 30; ++step) batch.step();
  EXPECT_EQ(batch.hash(0), of_five[0]);
  EXPECT_EQ(batch.hash(1), of_five[1]);
}

/// A few worlds of the small scene, and of one that is sensitive to the order of the rows, which is drawn for
/// each step.
std::vector<BatchOptions> some_batches(std::uint64_t seed) {
  BatchOptions crash;
  crash.scene = "100CrSk";
  crash.num_worlds = 5;
  crash.seed = seed;
  std::vector<BatchOptions> all = {small_options(5, seed), small_options(5, seed), crash, crash};
  all[0].settings = {{"stepper", "quick"}};
  all[3].settings = {{"row-order", "fixed"}};  // worlds at any step and of any seed then share lanes
  return all;
}

TEST(Batch, worlds_that_a_mask_resets_are_those_of_a_new_batch_and_the_others_go_on) {
  const std::array<bool, 5> mask = {false, true, false, true, true};
  for (const std::uint64_t seed : {1u, 7u}) {
    const auto before = some_batches(1), after = some_batches(seed);
    for (std::size_t i = 0; i < before.size(); ++i) {
      Batch batch = stepped(before[i], 5);
      batch.reset(mask, seed);
      EXPECT_EQ(std::vector(batch.steps().begin(), batch.steps().end()),
                (std::vector<std::int64_t>{5, 0, 5, 0, 0}));
      batch.step(20);
      const auto fresh = hashes(stepped(after[i], 20)), old = hashes(stepped(before[i], 25));
      for (std::size_t world = 0; world < mask.size(); ++world)
        EXPECT_EQ(batch.hash(static_cast<int>(world)), mask[world] ? fresh[world] : old[world])
            << "batch " << i << ", seed " << seed << ", world " << world;
    }
  }
}

TEST(Batch, a_reset_of_all_worlds_is_a_new_batch) {
  Batch batch = stepped(small_options(), 10);
  batch.reset(1);
  EXPECT_EQ(batch.hash(), Batch(small_options()).hash());
  batch.step(10);
  EXPECT_EQ(batch.hash(), stepped(small_options(), 10).hash());
}

TEST(Batch, saved_worlds_go_on_bit_for_bit) {
  Batch batch = stepped(small_options(), 12);
  batch.reset(std::array<bool, 5>{true, false, false, false, true},
              3);  // steps and seeds differ from here on
  batch.step(5);
  const auto saved = batch.save();
  const auto at_save = hashes(batch);
  batch.step(20);
  const auto reference = hashes(batch);
  Batch other(small_options(5, 9));
  for (Batch* each : {&batch, &other}) {
    each->load(saved);
    EXPECT_EQ(hashes(*each), at_save);
    EXPECT_EQ(std::vector(each->steps().begin(), each->steps().end()),
              (std::vector<std::int64_t>{5, 17, 17, 17, 5}));
    each->step(20);
    EXPECT_EQ(hashes(*each), reference);
  }
}

TEST(Batch, what_it_did_not_save_is_refused_and_nothing_changes) {
  Batch batch = stepped(small_options(), 3);
  const auto saved = batch.save();
  batch.step(3);
  const auto before = hashes(batch);
  const auto refuses = [&](const std::vector<std::byte>& bytes, const std::string& reason) {
    try {
      batch.load(bytes);
      ADD_FAILURE() << "loaded; expected: " << reason;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
    }
    EXPECT_EQ(hashes(batch), before);
  };
  refuses({}, "save()");
  refuses(std::vector<std::byte>(1000), "save()");
  for (std::size_t at = 20; at < saved.size(); at += 97) {
    auto damaged = saved;
    damaged[at] ^= std::byte{1};
    refuses(damaged, "damaged");
  }
  refuses({saved.begin(), saved.end() - 1}, "damaged");
  refuses(Batch(small_options(4)).save(), "4 saved worlds");
  BatchOptions other = small_options();
  other.settings = {{"law", "ode"}};
  refuses(Batch(other).save(), "other settings");
  other = small_options();
  other.settings = {{"solver-seed", "0"}};
  refuses(Batch(other).save(), "other settings");
  other = small_options();
  other.scene_text += "# another\n";
  refuses(Batch(other).save(), "scene 'small', whose text was another");
}

TEST(Batch, a_state_that_is_set_again_changes_no_bit) {
  for (const char* stepper : {"sor", "quick"}) {
    BatchOptions options = small_options();
    options.settings = {{"stepper", stepper}};
    Batch batch = stepped(options, 30);
    const auto before = hashes(batch);
    batch.set_state(BatchState(batch.state()));
    EXPECT_EQ(hashes(batch), before);
    batch.step(10);
    EXPECT_EQ(hashes(batch), hashes(stepped(options, 40))) << stepper;
  }
}

TEST(Batch, a_state_is_set_where_the_mask_says_so) {
  Batch batch = stepped(small_options(2), 5);
  const BatchState& live = batch.state();
  BatchState pushed = live;
  const std::size_t bob = 3, of_world = 4 * 3;
  for (const std::size_t world : {0u, 1u})
    pushed.velocity[world * of_world + 3 * bob + 1] = 2;  // [m/s] along y
  const std::array<bool, 2> second = {false, true};
  const std::uint64_t first = batch.hash(0);
  batch.set_state(pushed, second);
  EXPECT_EQ(batch.hash(0), first);
  EXPECT_EQ(&batch.state(), &live) << "the arrays stay where they are";
  EXPECT_EQ(live.velocity[of_world + 3 * bob + 1], 2);
  EXPECT_NE(live.velocity[3 * bob + 1], 2);
  batch.step();
  // A hundredth of a second at about 2 m/s, minus what the pivot takes away.
  EXPECT_GT(batch.state().position[of_world + 3 * bob + 1], 0.01);
}

TEST(Batch, what_sleeps_wakes_where_it_is_pushed_and_sleeps_on_elsewhere) {
  for (const char* stepper : {"sor", "quick"}) {
    BatchOptions options = small_options(2);
    options.settings = {{"stepper", stepper}, {"effects", "+sleeping"}};
    Batch batch = stepped(options, 1000), undisturbed = stepped(options, 1000);
    const std::size_t ball = 0, of_world = 4 * 3;
    BatchState pushed = batch.state();
    ASSERT_EQ(pushed.velocity[of_world + 2], 0) << stepper << ": it sleeps";
    pushed.velocity[of_world + 3 * ball + 2] = 3;  // [m/s] upwards
    batch.set_state(pushed);
    EXPECT_EQ(batch.hash(0), undisturbed.hash(0)) << stepper;
    for (Batch* each : {&batch, &undisturbed}) each->step(10);
    EXPECT_EQ(batch.hash(0), undisturbed.hash(0)) << stepper;
    // A tenth of a second at 3 m/s, minus what gravity takes away.
    EXPECT_NEAR(batch.state().position[of_world + 2] - undisturbed.state().position[of_world + 2], 0.25, 0.02)
        << stepper;
  }
}

TEST(Batch, shows_the_state_of_each_body_of_each_world) {
  Batch batch(small_options(2));
  const BatchState& state = batch.state();
  ASSERT_EQ(state.position.size(), 2u * 4 * 3);
  ASSERT_EQ(state.orientation.size(), 2u * 4 * 4);
  for (const std::size_t world : {0u, 1u}) {
    const double* door = &state.position[(world * 4 + 2) * 3];
    EXPECT_EQ((std::array{door[0], door[1], door[2]}), (std::array{0.45, 0.0, 1.1}));
    EXPECT_EQ(state.orientation[(world * 4 + 2) * 4], 1);
  }
  EXPECT_NE(state.position[0], state.position[4 * 3]) << "balls begin elsewhere in each world";
  const double height = state.position[2];
  batch.step(10);
  // Free fall over n = 140 substeps of h = dt / 14, each of which moves with its new velocity: g h^2 n (n +
  // 1) / 2.
  constexpr double h = 0.01 / 14;
  const double fall = 9.81 * h * h * 140 * 141 / 2;
  EXPECT_EQ(state.position[2], height) << "the arrays are refreshed by state() only";
  EXPECT_NEAR(batch.state().position[2], height - fall, 1e-12);
}

TEST(Batch, measures_its_worlds) {
  Batch batch(small_options(2));
  const double energy = batch.observable("energy")[0];
  // The energy exceeds the potential energy above z = 0 of the door and the bob alone.
  EXPECT_GT(energy, 9.81 * (30 * 1.1 + 2 * 1));
  batch.step(60);
  EXPECT_LT(batch.observable("energy")[0], energy) << "balls have landed";
  EXPECT_GE(batch.observable("contacts")[1], 2) << "a contact a ball";
  EXPECT_EQ(batch.observable("nonfinite"), (std::vector<double>{0, 0}));
  EXPECT_EQ(batch.observable("linear_momentum").size(), 2u * 3);
  for (const std::string& name : batch.observable_names())
    EXPECT_GE(batch.observable(name).size(), 2u) << name;
}

TEST(Batch, worlds_have_parameters_of_their_own_until_they_are_reset_with_others) {
  BatchOptions options = small_options(3);
  options.parameters = {
      {}, {{"bob.mass", "3"}, {"world.gravity", "[0, 0, -1.62]"}}, {{"hinge.motor.velocity", "2"}}};
  Batch batch = stepped(options, 10);
  const Batch without = stepped(small_options(3), 10);
  EXPECT_EQ(batch.hash(0), without.hash(0));
  EXPECT_NE(batch.hash(1), without.hash(1));
  const std::size_t of_world = 4 * 3, bob = 3 * 3, door = 2 * 3;
  EXPECT_NEAR(batch.state().velocity[of_world + bob + 2] / batch.state().velocity[bob + 2], 1.62 / 9.81, 1e-3)
      << "a pendulum let go from the horizontal falls by g t at first, whatever its mass";
  EXPECT_NEAR(batch.state().angular_velocity[2 * of_world + door + 2], 2, 0.02);
  batch.load(batch.save());
  batch.reset(1);
  batch.step(10);
  EXPECT_EQ(batch.hash(), stepped(options, 10).hash()) << "parameters stay in a reset that names none";
  batch.reset({}, 1, std::vector<Parameters>(3));
  batch.step(10);
  EXPECT_EQ(batch.hash(), without.hash());
}

TEST(Batch, has_the_same_bits_with_any_number_of_threads) {
  BatchOptions options = some_batches(1)[2];
  options.num_worlds = 40;
  const auto reference = hashes(stepped(options, 6));
  options.settings["threads"] = "3";
  EXPECT_EQ(hashes(stepped(options, 6)), reference);
}

TEST(Batch, is_moved_with_its_worlds) {
  Batch batch = stepped(small_options(), 4);
  Batch moved = std::move(batch);
  moved.step(4);
  EXPECT_EQ(moved.hash(), stepped(small_options(), 8).hash());
}

}  // namespace
}  // namespace pbmpi::test
