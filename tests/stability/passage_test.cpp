#include "stability/passage.h"

#include <gtest/gtest.h>

#include "core/random.h"
#include "support/models.h"

namespace pbmpi::stability {
namespace {

using model::Model;
using model::Shape;
using model::State;
using model::Vec3;

/// A static plate of 4 x 4 x 0.02 m at height 1 above the ground.
int add_plate(Model& model) {
  model::Geom plate;
  plate.actor = support::add_actor(model, "plate", model::ActorKind::wall);
  plate.shape = Shape::box;
  plate.size = {4, 4, 0.02};
  plate.local.position = {0, 0, 1};
  model.geoms.push_back(plate);
  return static_cast<int>(model.geoms.size()) - 1;
}

/// Body 0 is a ball of 0.2 m at height 2, above a plate above the ground; body 1 a cube of 0.4 m at x = 1.
Model ball_and_cube() {
  Model model;
  support::add_ground(model);
  add_plate(model);
  const int actor = support::add_actor(model, "bodies", model::ActorKind::prop, true);
  support::add_solid(model, actor, "ball", Shape::sphere, {0.2}, 1, {0, 0, 2});
  support::add_solid(model, actor, "cube", Shape::box, {0.4, 0.4, 0.4}, 1, {1, 0, 2});
  return model;
}

std::optional<Passage> moved(const Model& model, int body, const Vec3& from, const Vec3& to) {
  State before = initial_state(model);
  before.position[body] = from;
  State after = before;
  after.position[body] = to;
  return PassageFinder(model).find(before, before.position, after);
}

TEST(Passage, of_a_centre_through_a_static_plate_is_found) {
  const auto found = moved(ball_and_cube(), 0, {0, 0, 1.5}, {0, 0, 0.7});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->body, 0);
  EXPECT_EQ(found->through, 1);
  EXPECT_NEAR(found->beyond, 0.99 - 0.7, 1e-12);
}

TEST(Passage, beside_a_plate_or_up_to_it_is_none) {
  const Model model = ball_and_cube();
  EXPECT_FALSE(moved(model, 0, {3, 0, 1.5}, {3, 0, 0.7}));
  EXPECT_FALSE(moved(model, 0, {0, 0, 1.5}, {0, 0, 1.2}));
}

TEST(Passage, ends_where_a_thin_plate_is_in_the_middle_of_the_ball) {
  Model model = ball_and_cube();
  const auto found = moved(model, 0, {0, 0, 1.5}, {0, 0, 0.995});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->beyond, 0);
  EXPECT_FALSE(moved(model, 0, {0, 0, 0.995}, {0, 0, 0.7})) << "it was there before";
  model.geoms[1].size[2] = 0.5;  // thicker than the ball
  EXPECT_FALSE(moved(model, 0, {0, 0, 1.5}, {0, 0, 0.995}));
  EXPECT_TRUE(moved(model, 0, {0, 0, 1.5}, {0, 0, 0.5}));
}

TEST(Passage, of_a_slow_body_through_a_plate_is_looked_for_on_request) {
  const Model model = ball_and_cube();
  EXPECT_FALSE(moved(model, 0, {0, 0, 1.05}, {0, 0, 0.95}));
  State before = initial_state(model), after = before;
  before.position[0] = Vec3(0, 0, 1.05);
  after.position[0] = Vec3(0, 0, 0.95);
  EXPECT_TRUE(PassageFinder(model).find(before, before.position, after, PassageFinder::Pace::any));
}

TEST(Passage, through_the_ground_takes_a_depth_of_the_bodys_size) {
  const Model model = ball_and_cube();
  EXPECT_FALSE(moved(model, 0, {3, 0, 0.1}, {3, 0, -0.39}));
  const auto found = moved(model, 0, {3, 0, -0.39}, {3, 0, -0.41});  // however slowly
  ASSERT_TRUE(found);
  EXPECT_EQ(found->through, 0);
  EXPECT_NEAR(found->beyond, 0.41, 1e-12);
  EXPECT_FALSE(moved(model, 0, {3, 0, -0.5}, {3, 0, -0.6})) << "it was there before";
}

TEST(Passage, of_one_body_through_another_counts_their_relative_way) {
  const Model model = ball_and_cube();
  ASSERT_TRUE(moved(model, 0, {0.5, 0, 2}, {2.1, 0, 2}));
  EXPECT_FALSE(moved(model, 0, {0.5, 0, 2}, {1.9, 0, 2})) << "it is not wholly behind";
  State before = initial_state(model), after = before;
  before.position[0] = Vec3(0.5, 0, 2);
  after.position[0] = Vec3(2.1, 0, 2);
  after.position[1] += Vec3(1, 0, 0);  // moves along with it
  EXPECT_FALSE(PassageFinder(model).find(before, before.position, after));
}

TEST(Passage, past_a_cube_that_turns_is_none) {
  const Model model = ball_and_cube();
  State before = initial_state(model), after = before;
  // The path cuts a corner of the cube as turned by 45 degrees, but misses the cube as it was before.
  before.position[0] = Vec3(0.2, -0.25, 2);
  after.position[0] = Vec3(2.3, -0.25, 2);
  after.orientation[1] = support::rotation(Vec3::UnitZ(), std::acos(-1.0) / 4);
  EXPECT_FALSE(PassageFinder(model).find(before, before.position, after));
}

TEST(Passage, of_bodies_that_a_joint_connects_or_that_may_not_touch_is_none) {
  Model model = ball_and_cube();
  support::add_joint(model, model::JointKind::ball, 0, 1, {0.5, 0, 2});
  EXPECT_FALSE(moved(model, 0, {0.5, 0, 2}, {2.1, 0, 2}));
}

TEST(Passage, of_a_launched_body_begins_where_the_launch_has_put_it) {
  const Model model = ball_and_cube();
  State before = initial_state(model), after = before;
  before.position[0] = Vec3(0, 0, 0.5);  // below the plate
  after.position[0] = Vec3(0, 0, 1.5);
  std::vector<Vec3> from = before.position;
  from[0] = Vec3(0, 0, 1.2);
  EXPECT_FALSE(PassageFinder(model).find(before, from, after));
  EXPECT_TRUE(PassageFinder(model).find(before, before.position, after));
}

TEST(Passage, a_centre_in_the_plate_is_inside) {
  const Model model = ball_and_cube();
  State state = initial_state(model);
  const PassageFinder finder(model);
  EXPECT_FALSE(finder.find_inside(state)[0]);
  state.position[0] = Vec3(0.3, 0.1, 0.995);
  EXPECT_TRUE(finder.find_inside(state)[0]);
}

TEST(Passage, of_a_body_whose_centre_is_outside_its_geoms_is_not_looked_for) {
  Model model = ball_and_cube();
  for (model::Geom& geom : model.geoms) {
    if (geom.body == 0) geom.local.position = Vec3(0, 0, 0.3);
  }
  EXPECT_FALSE(moved(model, 0, {0, 0, 1.5}, {0, 0, 0.5}));
}

/// Tests on all bodies at once must hold for each: also for a body that is much smaller or much larger.
TEST(Passage, of_a_body_is_found_whatever_others_are_there) {
  const Model model = ball_and_cube();
  Model with_others = model;
  const int actor = support::add_actor(with_others, "others");
  support::add_solid(with_others, actor, "mote", Shape::sphere, {0.001}, 1, {50, 0, 9});
  support::add_solid(with_others, actor, "rock", Shape::sphere, {5}, 1, {-50, 0, 9});
  int num_found = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    const auto height = [&](std::uint64_t which) {
      return -1.5 + 4 * core::to_unit(core::mix_key(seed, which, 0));
    };
    const int body = static_cast<int>(seed % 2);
    const Vec3 from(body, 0, height(0)), to(body, 0, height(1));
    const auto alone = moved(model, body, from, to), among_others = moved(with_others, body, from, to);
    ASSERT_EQ(alone.has_value(), among_others.has_value()) << "seed " << seed;
    if (!alone) continue;
    ++num_found;
    EXPECT_EQ(alone->body, among_others->body);
    EXPECT_EQ(alone->through, among_others->through);
    EXPECT_EQ(alone->beyond, among_others->beyond);
  }
  EXPECT_GT(num_found, 100);
  EXPECT_LT(num_found, 400);
}

}  // namespace
}  // namespace pbmpi::stability
