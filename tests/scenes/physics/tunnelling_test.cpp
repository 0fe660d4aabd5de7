// A body at 89.4 m/s does not pass through a wall that is thinner than its displacement per step.
#include <gtest/gtest.h>

#include "every_stepper.h"

namespace pbmpi::scenes {
namespace {

class Tunnelling : public testing::TestWithParam<SteppedBy> {
 protected:
  /// Position x of the first body after 30 steps; `keys` describe a projectile that starts at x = `from`.
  double end_of(const std::string& keys, double from, const std::string& wall, const char* effects = "") {
    const std::string text = "title = \"shot\"\ngravity = [0, 0, 0]\n[[actor]]\nname = \"shot\"\n" + keys +
                             "mass = 5\nvelocity = [89.4, 0, 0]\nposition = [" + std::to_string(from) +
                             ", 0.1, 1]\n[[actor]]\nname = \"wall\"\ntype = \"box\"\n" + wall + effects;
    state_ = state_after(text, GetParam().settings, 30);
    return state_.position[0].x();
  }
  model::State state_;
};

INSTANTIATE_TEST_SUITE_P(EveryStepper, Tunnelling, testing::ValuesIn(every_stepper()),
                         [](const auto& test) { return test.param.name; });

constexpr const char* ball = "type = \"sphere\"\nradius = 0.1\n";
constexpr const char* thin_static_wall = "size = [0.02, 4, 4]\nposition = [0, 0, 1]\nstatic = true\n";

// Nine starts within one step's displacement, so that some step ends at any distance from the wall.
TEST_P(Tunnelling, of_a_static_wall_is_kept_from_balls_wherever_their_steps_end) {
  int num_lost = 0;
  for (int i = 0; i < 9; ++i) {
    const double from = -4 - 0.1 * i;
    // Stopped by its surface: 0.11 m before the middle of the wall, except for the penetration that soft
    // contacts allow.
    const double end = end_of(ball, from, thin_static_wall);
    EXPECT_LT(end, -0.1) << from;
    EXPECT_GT(end, -0.5) << from << ": it came as far as the wall";
    if (end_of(ball, from, thin_static_wall, "[effects]\nfast_bodies = false\n") > 1) ++num_lost;
  }
  EXPECT_GT(num_lost, 4) << "the test must be one that colliding at steps alone fails";
}

TEST_P(Tunnelling, of_a_static_wall_is_kept_from_all_shapes) {
  for (const char* shot :
       {"type = \"box\"\nsize = [0.2, 0.3, 0.2]\n", "type = \"capsule\"\nradius = 0.1\nlength = 0.3\n",
        "type = \"cylinder\"\nradius = 0.1\nlength = 0.3\n"}) {
    const double end = end_of(shot, -4.35, thin_static_wall);
    EXPECT_LT(end, 0) << shot;
    EXPECT_GT(end, -0.5) << shot;
  }
}

TEST_P(Tunnelling, of_a_ball_on_a_round_post_is_kept) {
  const double end = end_of(ball, -4.35, "size = [0.02, 0.02, 4]\nposition = [0, 0.1, 1]\nstatic = true\n");
  EXPECT_LT(end, 0);
}

// A plate of 20 kg takes on the ball's momentum: 5 kg x 89.4 m/s over 25 kg. In front of or behind the ball
// it moves on at their common speed, or faster: it is pushed, not passed.
TEST_P(Tunnelling, of_a_plate_that_gives_way_hands_on_the_momentum) {
  end_of(ball, -4.35, "size = [0.02, 4, 4]\nposition = [0, 0.1, 1]\nmass = 20\n");
  EXPECT_LT(state_.position[0].x(), state_.position[1].x());
  EXPECT_GT(state_.velocity[1].x(), 17);
  // Both steppers conserve the momentum that rows exchange up to rounding: 447 kg m/s, in single precision to
  // 1e-4 of it.
  EXPECT_NEAR(5 * state_.velocity[0].x() + 20 * state_.velocity[1].x(), 5 * 89.4, 0.05);
}

}  // namespace
}  // namespace pbmpi::scenes
