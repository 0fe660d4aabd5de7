// Materials of pairs of actors, in every stepper.
#include <gtest/gtest.h>

#include "every_stepper.h"

namespace pbmpi::scenes {
namespace {

/// Two boxes side by side on ground tilted by 20 degrees: the first is on ice, the second holds. The friction
/// from the geoms alone, 0.9 x 0.5, would hold both.
const std::string slope = R"(title = "t"
gravity = [3.355, 0, -9.218]
[[actor]]
name = "ground"
type = "ground"
[[actor]]
name = "box"
type = "box"
size = [0.5, 0.5, 0.2]
mass = 10
position = [0, 0, 0.1]
copies = 2
spacing = [0, 2, 0]
[[pair]]
actors = ["ground", "box"]
mu = 0.8
[[pair]]
actors = ["box.1", "ground"]
mu = 0
)";

class Pairs : public testing::TestWithParam<SteppedBy> {};

TEST_P(Pairs, have_friction_of_their_own) {
  constexpr double seconds = 1, slide_m = 0.5 * 3.355 * seconds * seconds;
  for (const stepping::Colliders colliders : {stepping::Colliders::lanes, stepping::Colliders::ode}) {
    stepping::StepperSettings settings = GetParam().settings;
    settings.law.colliders = colliders;
    const model::State state = state_after(slope, settings, 100);
    EXPECT_NEAR(state.position[0].x(), slide_m, 0.02 * slide_m) << "steps of 0.01 s are 1 % ahead";
    EXPECT_NEAR(state.position[1].x(), 0, 0.02);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryStepper, Pairs, testing::ValuesIn(every_stepper()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace pbmpi::scenes
