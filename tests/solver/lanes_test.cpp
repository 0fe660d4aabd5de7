/// The same bits in every lane: for every width, every packing and both number types.
#include "solver/lanes/lanes.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <tuple>

#include "core/hash.h"
#include "model/names.h"
#include "solver/sor_run.h"
#include "stepping/names.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

constexpr int num_steps = 60;  // well after the impact of the crash, when one wrong bit has grown to metres

/// A step without memory, the default step with a cone of friction at each contact, and the default step,
/// with patches of friction.
enum class Step { ode_law, remembering, patched };
using Kind = std::tuple<Step, stepping::Precision>;

stepping::StepperSettings settings_of(const Kind& kind, stepping::Simd simd) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  if (std::get<Step>(kind) == Step::ode_law)
    settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  if (std::get<Step>(kind) == Step::remembering) settings.law.friction = stepping::Friction::cone;
  settings.precision = std::get<stepping::Precision>(kind);
  settings.simd = simd;
  settings.seed = 7;
  return settings;
}

/// The hash of each world after num_steps.
std::vector<std::uint64_t> hashes(const std::vector<model::Model>& worlds,
                                  const stepping::StepperSettings& settings) {
  const auto stepper = make_stepper(settings, worlds);
  advance(*stepper, num_steps);
  std::vector<std::uint64_t> result;
  for (std::size_t i = 0; i < worlds.size(); ++i) result.push_back(hash(stepper->state(static_cast<int>(i))));
  return result;
}

std::vector<model::Model> crashes(int count) {
  std::vector<model::Model> worlds;
  for (int i = 0; i < count; ++i) worlds.push_back(support::crash(i));
  return worlds;
}

class Lanes : public testing::TestWithParam<Kind> {};

TEST_P(Lanes, every_width_gives_the_bits_of_one_lane) {
  const auto worlds = crashes(19);  // fills some lanes of each width, and leaves some idle
  const auto one_lane = hashes(worlds, settings_of(GetParam(), stepping::Simd::off));
  for (const stepping::Simd simd : machine_simds()) {
    EXPECT_EQ(hashes(worlds, settings_of(GetParam(), simd)), one_lane) << stepping::name_of(simd);
  }
}

TEST_P(Lanes, a_world_does_not_notice_its_neighbours) {
  std::vector<model::Model> worlds = crashes(5);
  worlds.insert(worlds.begin() + 2, support::pile(12));  // another shape of world in the same pack
  worlds.push_back(support::chain(9));
  const auto settings = settings_of(GetParam(), stepping::Simd::automatic);
  const auto together = hashes(worlds, settings);
  for (std::size_t i = 0; i < worlds.size(); ++i)
    EXPECT_EQ(hashes({worlds[i]}, settings).front(), together[i]) << i;
}

/// The bits themselves, for every compiler, build and machine: no computation is left to a library. A commit
/// that changes them says why.
TEST_P(Lanes, a_crash_ends_in_the_same_bits_everywhere) {
  static const std::map<Kind, std::uint64_t> golden = {
      {{Step::ode_law, stepping::Precision::double_}, 0x7b325a0da682e799},
      {{Step::ode_law, stepping::Precision::single}, 0x3592c40ab9c3ba38},
      {{Step::remembering, stepping::Precision::double_}, 0xf012dbc458dd1612},
      {{Step::remembering, stepping::Precision::single}, 0x25c42ab45231120d},
      {{Step::patched, stepping::Precision::double_}, 0xfd709e9b3ee62eb6},
      {{Step::patched, stepping::Precision::single}, 0x391869af05a0b146},
  };
  for (const stepping::Simd simd : machine_simds())
    EXPECT_EQ(hashes(crashes(1), settings_of(GetParam(), simd)).front(), golden.at(GetParam()))
        << stepping::name_of(simd);
}

TEST_P(Lanes, worlds_differ_from_each_other) {
  const auto values = hashes(crashes(3), settings_of(GetParam(), stepping::Simd::automatic));
  EXPECT_NE(values[0], values[1]);
  EXPECT_NE(values[1], values[2]);
}

TEST_P(Lanes, a_world_that_moves_to_another_stepper_goes_on_bit_for_bit) {
  const auto settings = settings_of(GetParam(), stepping::Simd::automatic);
  const auto worlds = crashes(3);
  const auto stayed = make_stepper(settings, worlds);
  advance(*stayed, 20);
  const auto moved = make_stepper(settings);
  moved->add(1, std::make_shared<const model::Model>(worlds[1]), stayed->state(1), 20);
  advance(*stayed, num_steps);
  advance(*moved, num_steps);
  EXPECT_EQ(hash(moved->state(1)), hash(stayed->state(1)));
}

std::string name_of(const testing::TestParamInfo<Kind>& test) {
  constexpr std::array steps = {"cold_", "remembering_", "patched_"};
  const auto [step, precision] = test.param;
  return steps.at(static_cast<std::size_t>(step)) + std::string(stepping::name_of(precision));
}

INSTANTIATE_TEST_SUITE_P(EveryStep, Lanes,
                         testing::Combine(testing::Values(Step::ode_law, Step::remembering, Step::patched),
                                          testing::Values(stepping::Precision::double_,
                                                          stepping::Precision::single)),
                         name_of);

}  // namespace
}  // namespace pbmpi::solver
