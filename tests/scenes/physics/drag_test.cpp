// Air drag slows bodies down with every stepper.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "../helpers.h"
#include "every_stepper.h"
#include "scenes/scene.h"
#include "solver/pack/simd.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::scenes {
namespace {

class Drag : public testing::TestWithParam<SteppedBy> {};

INSTANTIATE_TEST_SUITE_P(EveryStepper, Drag, testing::ValuesIn(every_stepper()),
                         [](const auto& test) { return test.param.name; });

constexpr const char* ball =
    "[[actor]]\nname = \"ball\"\ntype = \"sphere\"\nradius = 0.5\nmass = 2\nposition = [0, 0, 900]\n";

TEST_P(Drag, lets_a_falling_ball_reach_its_terminal_velocity) {
  constexpr double mass_kg = 2, gravity = 9.81, density = 1.2, cd = 0.47, area = std::numbers::pi * 0.25;
  const double terminal = std::sqrt(2 * mass_kg * gravity / (density * cd * area));  // 9.4 m/s
  const model::State state =
      state_after(std::string("title = \"t\"\n[air]\ndensity = 1.2\n") + ball, GetParam().settings, 1000);
  EXPECT_NEAR(state.velocity[0].z(), -terminal, 0.01 * terminal);
  EXPECT_NEAR(state.velocity[0].x(), 0, 1e-9);
}

TEST_P(Drag, is_left_out_by_choice) {
  const std::string still = std::string("title = \"t\"\n") + ball;
  const std::string air =
      "title = \"t\"\n[air]\ndensity = 1.2\n[effects]\ndrag = false\n" + std::string(ball);
  EXPECT_EQ(model::hash(state_after(air, GetParam().settings, 50)),
            model::hash(state_after(still, GetParam().settings, 50)));
}

TEST(AirDensity, must_not_be_negative) {
  const std::string error = error_of(std::string("title = \"t\"\n[air]\ndensity = -1\n") + ball);
  EXPECT_NE(error.find("test.toml:3"), std::string::npos) << error;
  EXPECT_NE(error.find("density"), std::string::npos) << error;
}

// Balls that fall on each other in thick air, which combines contacts and drag.
TEST(DragOfSor, has_the_same_bits_with_every_instruction_set) {
  const std::string scene =
      "title = \"t\"\n[air]\ndensity = 50\n"
      "[[actor]]\nname = \"ground\"\ntype = \"ground\"\n"
      "[[actor]]\nname = \"balls\"\ntype = \"sphere\"\nradius = 0.5\nmass = 2\nposition = [0, 0, 1]\n"
      "velocity = [3, 0, 0]\ncopies = 9\nspacing = [0.3, 0.1, 1.05]\n";
  for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
    stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
    settings.precision = precision;
    const std::uint64_t expected = model::hash(state_after(scene, settings, 100));
    for (const stepping::Simd simd :
         {stepping::Simd::off, stepping::Simd::sse2, stepping::Simd::avx2, stepping::Simd::avx512}) {
      if (!solver::has_simd(simd)) continue;
      settings.simd = simd;
      EXPECT_EQ(model::hash(state_after(scene, settings, 100)), expected);
    }
  }
}

}  // namespace
}  // namespace pbmpi::scenes
