// Velocities decay as exp(-damping t), for any step.
#include <cmath>

#include <gtest/gtest.h>

#include "every_stepper.h"

namespace pbmpi::scenes {
namespace {

class Damping : public testing::TestWithParam<SteppedBy> {};

INSTANTIATE_TEST_SUITE_P(EveryStepper, Damping, testing::ValuesIn(every_stepper()),
                         [](const auto& test) { return test.param.name; });

constexpr const char* ball =
    "[[actor]]\nname = \"ball\"\ntype = \"sphere\"\nradius = 0.5\nmass = 2\nposition = [0, 0, 5]\n"
    "velocity = [3, -2, 1]\nangular_velocity = [1, 2, -4]\n";

TEST_P(Damping, is_an_exponential_decay_of_any_step) {
  for (const int num_steps : {10, 100}) {
    stepping::StepperSettings settings = GetParam().settings;
    settings.dt_s = 1.0 / num_steps;
    const model::State state = state_after(
        std::string("title = \"t\"\ngravity = [0, 0, 0]\nlinear_damping = 0.7\nangular_damping = 2\n") + ball,
        settings, num_steps);
    // Each of 300 products in single precision loses 6e-8 of a number below 4.
    EXPECT_LT((state.velocity[0] - std::exp(-0.7) * model::Vec3(3, -2, 1)).norm(), 1e-4);
    EXPECT_LT((state.angular_velocity[0] - std::exp(-2.0) * model::Vec3(1, 2, -4)).norm(), 1e-4);
  }
}

// Damping acts after a step's move by h (v + g h), so the first step's displacement is not damped.
TEST_P(Damping, acts_on_the_velocity_after_the_move) {
  stepping::StepperSettings settings = GetParam().settings;
  settings.substeps = 1;
  const model::State state = state_after(
      std::string("title = \"t\"\ngravity = [0, 0, -10]\nlinear_damping = 50\n") + ball, settings, 1);
  EXPECT_NEAR(state.position[0].z(), 5 + 0.01 * (1 - 0.1), 1e-6);  // single precision has 6e-7 at 5
  EXPECT_NEAR(state.velocity[0].z(), std::exp(-0.5) * (1 - 0.1), 1e-6);
}

}  // namespace
}  // namespace pbmpi::scenes
