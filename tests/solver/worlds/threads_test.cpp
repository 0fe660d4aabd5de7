// Worlds that several threads step.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <memory>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "ode/collide/narrow_phase.h"
#include "solver/parts/yards.h"
#include "solver/sor_run.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Model;
using model::State;
using stepping::StepperSettings;

/// Worlds of several kinds, with all shapes and kinds of joints among them: some have laws of their own, in
/// some bodies sleep and wake, and joints break.
std::vector<Model> many_worlds() {
  std::vector<Model> worlds;
  for (int i = 0; i < 18; ++i) worlds.push_back(support::crash(i));
  for (int i = 0; i < 3; ++i) {
    Model pile = support::pile(4 + i);
    pile.effects["sleeping"] = true;
    worlds.push_back(std::move(pile));
    worlds.push_back(support::falling_balls(2, 0.5, i));
    worlds.push_back(testing_support::yard_with_ball(10 + i));
    Model chain = support::chain(5);
    chain.erp = 0.3;
    chain.joints[1].break_force = 60;
    worlds.push_back(std::move(chain));
  }
  return worlds;
}

struct Setting {
  std::string name;
  StepperSettings settings;
};
std::ostream& operator<<(std::ostream& out, const Setting& setting) { return out << setting.name; }

std::vector<Setting> every_setting() {
  const StepperSettings by_default = default_settings(stepping::StepperKind::sor);
  StepperSettings single = by_default, ode = by_default, fixed = by_default, shares = by_default;
  single.precision = stepping::Precision::single;
  ode.law.colliders = stepping::Colliders::ode;
  fixed.law.row_order = stepping::RowOrder::fixed;
  shares.tolerance_m = 1e-5;
  return {{"default", by_default},
          {"single", single},
          {"ode_colliders", ode},
          {"fixed_order", fixed},
          {"island_shares", shares}};
}

using Stepper = std::unique_ptr<stepping::WorldStepper>;

Stepper start(StepperSettings settings, int num_threads, const std::vector<Model>& worlds) {
  settings.threads = num_threads;
  auto stepper = make_sor_stepper(settings, ode::make_narrow_phase);
  for (std::size_t i = 0; i < worlds.size(); ++i)
    stepper->add(static_cast<int>(i), std::make_shared<const Model>(worlds[i]), initial_state(worlds[i]), 0);
  return stepper;
}

std::vector<std::uint64_t> hashes(const stepping::WorldStepper& stepper, int num_worlds) {
  std::vector<std::uint64_t> all;
  for (int world = 0; world < num_worlds; ++world) all.push_back(model::hash(stepper.state(world)));
  return all;
}

class ThreadsOfEachSetting : public testing::TestWithParam<Setting> {
 protected:
  /// `run` does the same with a stepper of each number of threads, and returns what must be equal.
  template <class Run>
  void expect_same(const std::vector<Model>& worlds, const Run& run) const {
    const auto expected = run(*start(GetParam().settings, 1, worlds));
    for (const int num_threads : {2, 3, 7})
      EXPECT_EQ(run(*start(GetParam().settings, num_threads, worlds)), expected) << num_threads << " threads";
  }
};
INSTANTIATE_TEST_SUITE_P(Sor, ThreadsOfEachSetting, testing::ValuesIn(every_setting()),
                         [](const auto& test) { return test.param.name; });

TEST_P(ThreadsOfEachSetting, of_any_number_give_the_same_bits) {
  const std::vector<Model> worlds = many_worlds();
  expect_same(worlds, [&](stepping::WorldStepper& stepper) {
    for (int i = 0; i < 8; ++i) advance(stepper, 3);
    std::vector<double> seen;
    for (int world = 0; world < std::ssize(worlds); ++world)
      seen.push_back(stepper.observables(world).energy_j + stepper.observables(world).rows);
    return std::pair(hashes(stepper, static_cast<int>(worlds.size())), seen);
  });
}

TEST_P(ThreadsOfEachSetting, give_the_same_bits_where_worlds_come_go_and_change) {
  const std::vector<Model> worlds = many_worlds();
  expect_same(worlds, [&](stepping::WorldStepper& stepper) {
    advance(stepper, 5);
    const State state = stepper.state(3);
    stepper.remove(3);
    stepper.set_state(7, initial_state(worlds[7]), 0);
    stepper.set_state(20, initial_state(worlds[20]), 5);
    advance(stepper, 4);
    stepper.add(3, std::make_shared<const Model>(worlds[3]), state, 5);
    advance(stepper, 5);
    return hashes(stepper, static_cast<int>(worlds.size()));
  });
}

TEST(Threads, share_out_the_cost_of_their_worlds) {
  const std::vector<Model> worlds = many_worlds();
  const auto stepper = start(default_settings(stepping::StepperKind::sor), 3, worlds);
  core::PhaseTimes times;
  stepper->advance(3, times);
  double sum_s = 0;
  for (int world = 0; world < std::ssize(worlds); ++world) {
    EXPECT_GT(stepper->cost_s(world), 0);
    sum_s += stepper->cost_s(world);
  }
  // Phases leave out the work of a group between them, and a call's entry and exit.
  EXPECT_LE(times.useful_s(), sum_s * (1 + 1e-9));
  EXPECT_GT(times.useful_s(), 0.5 * sum_s);
}

/// Collides nothing, and calls back instead.
class Calling final : public model::NarrowPhase {
 public:
  explicit Calling(std::function<void()> call) : call_(std::move(call)) {}
  void collide(std::span<const model::BodyPose>, std::span<const model::GeomPair>,
               std::vector<model::Contact>&) override {
    call_();
  }

 private:
  std::function<void()> call_;
};

/// A box in the ground for each of two threads' packs.
Stepper two_groups(const model::MakeNarrowPhase& make_narrow_phase) {
  StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.threads = 2;
  settings.law.colliders = stepping::Colliders::ode;
  settings.simd = stepping::Simd::off;  // a world is a batch
  auto stepper = make_sor_stepper(settings, make_narrow_phase);
  const Model model = support::box_over_ground(-0.1);
  for (int world = 0; world < 2; ++world)
    stepper->add(world, std::make_shared<const Model>(model), initial_state(model), 0);
  return stepper;
}

TEST(Threads, step_groups_at_the_same_time) {
  std::atomic<int> arrived = 0;
  const auto stepper = two_groups([&](const Model&) {
    return std::make_unique<Calling>([&] {
      ++arrived;
      while (arrived < 2) std::this_thread::yield();  // for the other group: alone it would wait for ever
    });
  });
  advance(*stepper, 1);
  EXPECT_EQ(arrived, 2);
}

TEST(Threads, hand_an_exception_to_the_caller) {
  std::atomic<int> made = 0;
  const auto stepper = two_groups([&](const Model&) {
    return std::make_unique<Calling>([fails = ++made == 2] {
      if (fails) throw std::runtime_error("the second world");
    });
  });
  try {
    advance(*stepper, 1);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the second world");
  }
}

}  // namespace
}  // namespace pbmpi::solver
