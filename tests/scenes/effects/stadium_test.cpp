// Few iterations are enough far from the viewer: the effect "field_of_interest".
#include <gtest/gtest.h>

#include "stepped_scene.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::scenes {
namespace {

using stepping::StepperKind;

constexpr int car_bodies = 5, human_bodies = 16, num_humans = 75;

TEST(Stadium, calls_for_the_field_of_interest) {
  const SteppedScene scene("Stadium");
  EXPECT_EQ(scene.model().num_bodies(), car_bodies + num_humans * human_bodies);
  EXPECT_EQ(scene.reason(effects::EffectId::field_of_interest),
            "within 5 m of 'car.chassis'; elsewhere at most 4 iterations");
}

// While all humans are in the air, each is an island of its own.
TEST(Stadium, whole_humans_are_inside_and_others_once_the_car_has_moved_on) {
  SteppedScene scene("Stadium", {}, default_settings(StepperKind::quick));
  const double radius = scene.model().interest->radius_m;
  scene.frame();
  const int at_start = scene.observables().bodies_inside;
  EXPECT_EQ((at_start - car_bodies) % human_bodies, 0) << at_start;
  EXPECT_GT(at_start, car_bodies);
  EXPECT_LT(at_start, scene.model().num_bodies() / 2);
  int near = 0;
  for (const core::Vec3& position : scene.state().position)
    near +=
        (position - scene.state().position[0]).norm() < radius - 0.5 ? 1 : 0;  // they move by less in a step
  EXPECT_GE(at_start, near);
  for (int frame = 1; frame < 30; ++frame) scene.frame();
  EXPECT_NE(scene.observables().bodies_inside, at_start);
  EXPECT_EQ(scene.observables().nonfinite, 0);
}

// The car is always inside, and rolls on its own: how other bodies are solved does not affect it.
TEST(Stadium, only_what_is_outside_is_solved_otherwise) {
  stepping::StepperSettings settings = default_settings(StepperKind::sor);
  settings.iterations = 8;  // above the field's 4
  SteppedScene with("Stadium", {}, settings), without("Stadium", {{"field_of_interest", false}}, settings);
  with.seconds(0.6);
  without.seconds(0.6);
  int same = 0;
  for (int body = 0; body < with.model().num_bodies(); ++body) {
    const bool is_same = with.state().position[body] == without.state().position[body];
    EXPECT_TRUE(is_same || body >= car_bodies) << with.model().bodies[body].name;
    same += is_same ? 1 : 0;
  }
  EXPECT_LT(same, with.model().num_bodies() * 3 / 4);
}

}  // namespace
}  // namespace pbmpi::scenes
