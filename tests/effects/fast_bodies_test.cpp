#include "effects/fast_bodies.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/geometry.h"
#include "support/models.h"
#include "support/slow_bounds.h"

namespace pbmpi::effects {
namespace {

constexpr double dt_s = 0.01;
constexpr double rounding = 1e-12;  // of a few operations on lengths of some metres

int add_ball(model::Model& model, const std::string& name, const core::Vec3& position,
             const core::Vec3& velocity) {
  const int actor = support::add_actor(model, name);
  const int body = support::add_solid(model, actor, name, model::Shape::sphere, {0.1, 0, 0}, 1, position);
  model.bodies[body].velocity = velocity;
  return body;
}

int add_wall(model::Model& model, double x, double thickness) {
  const int actor = support::add_actor(model, "wall");
  return support::add_solid(model, actor, "wall", model::Shape::box, {thickness, 2, 2}, 50, {x, 0, 1});
}

const FastBodies::Filter all = [](int, int) { return true; };

std::vector<model::Contact> contacts_of(const model::Model& model, const FastBodies::Filter& filter = all) {
  FastBodies fast(model);
  const model::State state = model::initial_state(model);
  std::vector<model::Contact> contacts;
  if (fast.look(state, dt_s)) fast.add(state, filter, contacts);
  return contacts;
}

bool any_is_fast(const model::Model& model) {
  FastBodies fast(model);
  return fast.look(model::initial_state(model), dt_s);
}

bool bounds_hold(const model::Model& model) { return support::keeps_slow_bounds(model, dt_s); }

TEST(FastBodies, are_those_that_move_further_than_half_their_extent_along_their_way) {
  model::Model model;
  add_ball(model, "ball", {0, 0, 1}, {9.9, 0, 0});
  EXPECT_FALSE(any_is_fast(model));
  model.bodies[0].velocity.x() = 10.1;
  EXPECT_TRUE(any_is_fast(model));
  model.bodies[0].velocity.x() = 0;
  // A plate of 2 m by 5 cm that flies edge first cannot skip anything in a step; one that flies flat can.
  const int plate = support::add_solid(model, support::add_actor(model, "plate"), "plate", model::Shape::box,
                                       {2, 2, 0.05}, 1, {0, 5, 1});
  model.bodies[plate].velocity = {50, 0, 0};
  EXPECT_FALSE(any_is_fast(model));
  model.bodies[plate].velocity = {0, 0, 50};
  EXPECT_TRUE(any_is_fast(model));
}

TEST(SlowBounds, are_left_before_a_geom_is_fast_and_not_long_before) {
  model::Model model;
  add_ball(model, "ball", {0, 0, 1}, {4.8, 0, 0});
  EXPECT_TRUE(bounds_hold(model));
  model.bodies[0].velocity.x() = 5.1;
  EXPECT_FALSE(bounds_hold(model));
  model.bodies[0].velocity = {0, 0, 0};
  model.bodies[0].angular_velocity = {1000, 0, 0};
  EXPECT_TRUE(bounds_hold(model)) << "a turn does not move the ball's middle";
  model.geoms[0].local.position = {0, 0.5, 0};
  EXPECT_FALSE(bounds_hold(model));
  model.bodies[0].angular_velocity = {9, 0, 0};  // the middle moves by 4.5 cm per step
  EXPECT_TRUE(bounds_hold(model));
}

TEST(SlowBounds, of_a_body_without_geoms_hold_at_any_speed) {
  model::Model model;
  add_ball(model, "ghost", {0, 0, 1}, {1e6, 0, 0});
  model.geoms.clear();
  EXPECT_TRUE(bounds_hold(model));
}

/// A number between -1 and 1.
double random_number(int sample, int which) {
  return 2 * core::to_unit(
                 core::mix_key(1, static_cast<std::uint64_t>(sample), static_cast<std::uint64_t>(which))) -
         1;
}

core::Vec3 random_vector(int sample, int which, double most) {
  return most * core::Vec3(random_number(sample, which), random_number(sample, which + 1),
                           random_number(sample, which + 2));
}

// Where the bounds hold the pass would find nothing, so it need not look.
TEST(SlowBounds, hold_in_no_random_state_in_which_a_geom_is_fast) {
  int num_fast = 0, num_held = 0;
  for (int sample = 0; sample < 20000; ++sample) {
    model::Model model;
    const int actor = support::add_actor(model, "thing");
    const auto size = [&](int which) { return 0.02 + 0.5 * std::abs(random_number(sample, which)); };
    const std::array shapes = {model::Shape::sphere, model::Shape::capsule, model::Shape::box,
                               model::Shape::cylinder};
    support::add_solid(model, actor, "thing", shapes[static_cast<std::size_t>(sample % 4)],
                       {size(0), size(1), size(2)}, 1, {0, 0, 1});
    if (sample % 3 == 0) model.geoms[0].local.position = random_vector(sample, 3, 0.5);
    const double speed = std::exp(5 * random_number(sample, 6));
    model.bodies[0].velocity = random_vector(sample, 7, speed);
    model.bodies[0].angular_velocity = random_vector(sample, 10, 4 * speed);
    const bool is_fast = any_is_fast(model), held = bounds_hold(model);
    EXPECT_FALSE(is_fast && held) << sample;
    num_fast += is_fast ? 1 : 0;
    num_held += held ? 1 : 0;
  }
  EXPECT_GT(num_fast, 1000);
  EXPECT_GT(num_held, 1000);
}

// The ball's centre is 0.5 m in front of the wall's face, its surface 0.4 m.
TEST(FastBodies, leave_a_gap_that_the_surfaces_may_close) {
  model::Model model;
  add_ball(model, "ball", {-0.55, 0.2, 1}, {89.4, 0, 0});
  add_wall(model, 0, 0.1);
  const auto contacts = contacts_of(model);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].body_a, 0);
  EXPECT_EQ(contacts[0].body_b, 1);
  EXPECT_NEAR(contacts[0].depth, -0.4, rounding);
  EXPECT_LT((contacts[0].normal - core::Vec3(-1, 0, 0)).norm(), rounding);
  EXPECT_LT((contacts[0].position - core::Vec3(-0.25, 0.2, 1)).norm(), rounding) << "half way";
}

// None of the speed is left for a contact of the next step.
TEST(FastBodies, have_the_friction_and_restitution_of_their_surfaces) {
  model::Model model;
  add_ball(model, "ball", {-0.55, 0.2, 1}, {89.4, 0, 0});
  add_wall(model, 0, 0.1);
  model.geoms[0].material = {0.9, 0.3};
  model.geoms[1].material = {0.4, 0.2};
  const auto contacts = contacts_of(model);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(contacts[0].mu, 0.6, rounding);
  EXPECT_EQ(contacts[0].restitution, 0.3);
}

TEST(FastBodies, that_overlap_act_at_the_surface_of_the_body_that_turns) {
  model::Model model;
  support::add_ground(model);
  add_ball(model, "ball", {0, 0, 0.02}, {60, 0, -60});
  const auto contacts = contacts_of(model);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].depth, 0);
  EXPECT_LT((contacts[0].position - core::Vec3(0, 0, -0.08)).norm(), rounding);
}

// The face is 0.99 m or 1 m away: the centre moves 0.894 m, and the front is 0.1 m ahead of it.
TEST(FastBodies, find_what_their_front_reaches_in_a_step) {
  model::Model model;
  add_ball(model, "ball", {-1.04, 0, 1}, {89.4, 0, 0});
  add_wall(model, 0, 0.1);
  EXPECT_EQ(contacts_of(model).size(), 1u);
  model.bodies[0].pose.position.x() = -1.05;
  EXPECT_TRUE(contacts_of(model).empty());
}

TEST(FastBodies, find_nothing_far_ahead_or_behind) {
  for (const double x : {-2.0, 0.3}) {
    model::Model model;
    add_ball(model, "ball", {x, 0, 1}, {89.4, 0, 0});
    add_wall(model, 0, 0.1);
    EXPECT_TRUE(contacts_of(model).empty()) << x;
  }
}

TEST(FastBodies, on_static_ground_act_below_their_centre) {
  model::Model model;
  support::add_ground(model);
  add_ball(model, "ball", {0, 0, 0.4}, {60, 0, -60});
  const auto contacts = contacts_of(model);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].body_a, 0);
  EXPECT_EQ(contacts[0].body_b, model::no_body);
  EXPECT_LT((contacts[0].normal - core::Vec3::UnitZ()).norm(), rounding);
  EXPECT_NEAR(contacts[0].depth, -0.3, rounding);
  EXPECT_LT((contacts[0].position - core::Vec3(0, 0, 0.15)).norm(), rounding)
      << "not where the way ends, 0.4 m ahead";
}

// They approach each other at 80 m/s each and meet halfway, 0.3 m apart; neither displacement alone reaches
// the other ball.
TEST(FastBodies, see_each_other_once_by_their_relative_way) {
  model::Model model;
  add_ball(model, "left", {-0.7, 0, 1}, {80, 0, 0});
  add_ball(model, "right", {0.7, 0, 1}, {-80, 0, 0});
  const auto contacts = contacts_of(model);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(contacts[0].depth, -1.2, rounding);
  model.bodies[1].velocity = {80, 0, 0};
  EXPECT_TRUE(contacts_of(model).empty()) << "side by side";
}

// Its centre is 0.15 m above the ground, its end 0.02 m deep in it.
TEST(FastBodies, keep_the_middle_of_a_rod_that_touches_with_its_end) {
  model::Model model;
  support::add_ground(model);
  const int rod =
      support::add_solid(model, support::add_actor(model, "rod"), "rod", model::Shape::capsule,
                         {0.02, 0.3, 0}, 1, {0, 0, 0.15}, support::rotation(core::Vec3::UnitY(), 0.0));
  model.bodies[rod].velocity = {0, 0, -60};
  FastBodies fast(model);
  const model::State state = model::initial_state(model);
  ASSERT_TRUE(fast.look(state, dt_s));
  model::Contact touching;
  touching.geoms = {0, 1};
  touching.position = touching.normal = core::Vec3::UnitX();
  touching.depth = 0.02;
  std::vector<model::Contact> contacts = {touching};
  fast.add(state, all, contacts);
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(contacts[0].depth, 0.02) << "the touch comes first";
  EXPECT_EQ(contacts[1].geoms, touching.geoms);
  EXPECT_EQ(contacts[1].depth, 0) << "no gap is left";
}

TEST(FastBodies, pass_what_they_may_not_touch) {
  model::Model model;
  add_ball(model, "ball", {-0.55, 0, 1}, {89.4, 0, 0});
  add_wall(model, 0, 0.1);
  ASSERT_EQ(contacts_of(model).size(), 1u);
  model.geoms[1].actor = model.geoms[0].actor;
  EXPECT_TRUE(contacts_of(model).empty()) << "one actor's geoms do not touch each other";
}

/// Twelve fast balls that approach each other over static ground, with a wall in the middle.
model::Model converging_balls() {
  model::Model model;
  support::add_ground(model);
  for (int i = 0; i < 12; ++i) {
    const double angle = 0.5 * i;
    add_ball(model, "ball" + std::to_string(i),
             {0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.3 + 0.05 * i},
             {-70 * std::cos(angle), -70 * std::sin(angle), -30});
  }
  add_wall(model, 0, 0.1);
  return model;
}

void expect_same(const std::vector<model::Contact>& a, const std::vector<model::Contact>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].geoms, b[i].geoms);
    EXPECT_EQ(a[i].position, b[i].position);
    EXPECT_EQ(a[i].depth, b[i].depth);
  }
}

// The contacts of each pair depend on that pair alone: any split by a filter gives the same contacts as no
// split.
TEST(FastBodies, find_the_same_in_any_parts) {
  const model::Model model = converging_balls();
  const auto whole = contacts_of(model);
  ASSERT_GT(whole.size(), 12u);
  const auto of_part = [](int geom) { return geom * 7 % 3; };
  auto parts = contacts_of(model, [&](int a, int b) { return of_part(a) == of_part(b); });
  const auto across = contacts_of(model, [&](int a, int b) { return of_part(a) != of_part(b); });
  parts.insert(parts.end(), across.begin(), across.end());
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.geoms < b.geoms; });
  expect_same(parts, whole);
  for (std::size_t i = 1; i < whole.size(); ++i)
    EXPECT_LT(whole[i - 1].geoms, whole[i].geoms) << "canonical order, one contact a pair";
}

TEST(FastBodies, find_across_groups_what_a_filter_would_let_through) {
  const model::Model model = converging_balls();
  const model::State state = model::initial_state(model);
  for (const int num_groups : {1, 2, 3}) {
    std::vector<int> group;
    for (int body = 0; body < model.num_bodies(); ++body) group.push_back(body % num_groups);
    const auto across = [&](int a, int b) {
      const int body_a = model.geoms[a].body, body_b = model.geoms[b].body;
      return body_a >= 0 && body_b >= 0 && group[body_a] != group[body_b];
    };
    FastBodies fast(model);
    std::vector<model::Contact> found;
    ASSERT_TRUE(fast.look(state, dt_s));
    fast.add_across(state, group, found);
    expect_same(found, contacts_of(model, across));
    EXPECT_EQ(found.empty(), num_groups == 1);
  }
  // All fast bodies are in one group; only the wall is in another.
  std::vector<int> group(model.bodies.size(), 0);
  group.back() = 1;
  FastBodies fast(model);
  std::vector<model::Contact> found;
  ASSERT_TRUE(fast.look(state, dt_s));
  fast.add_across(state, group, found);
  const int wall = static_cast<int>(model.geoms.size()) - 1;
  expect_same(found, contacts_of(model, [&](int, int other) { return other == wall; }));
  EXPECT_FALSE(found.empty());
}

std::vector<model::Contact> approaches_of(const model::Model& model, double most_approach_m = 0.05) {
  FastBodies fast(model, most_approach_m);
  const model::State state = model::initial_state(model);
  std::vector<model::Contact> contacts;
  if (fast.look(state, dt_s)) fast.add(state, all, contacts);
  std::erase_if(contacts, [](const model::Contact& contact) { return !contact.is_approach(); });
  return contacts;
}

// 8 m/s, 8 cm a step; the surfaces are 10 cm apart, or 20.
TEST(Approaches, are_of_bodies_that_may_begin_to_touch_within_the_step) {
  model::Model model;
  add_ball(model, "ball", {-0.25, 0.2, 1}, {8, 0, 0});
  add_wall(model, 0, 0.1);
  const auto found = approaches_of(model);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].body_a, 0);
  EXPECT_EQ(found[0].body_b, 1);
  EXPECT_NEAR(found[0].approach, 0.08, rounding);
  EXPECT_TRUE(approaches_of(model, 0.09).empty()) << "it comes nearer by less than that";
  EXPECT_TRUE(contacts_of(model).empty()) << "it is not fast";
  model.geoms[0].local.position.x() = -0.1;
  EXPECT_TRUE(approaches_of(model).empty()) << "the wall is too far off";
  model.bodies[0].velocity = {-8, 0, 0};
  model.geoms[0].local.position.x() = 0;
  EXPECT_TRUE(approaches_of(model, 0.07).empty()) << "what moves away at 8 cm a step leaves all behind";
}

TEST(Approaches, of_two_that_move_are_by_their_relative_motion) {
  model::Model model;
  add_ball(model, "a", {-0.15, 0, 1}, {20, 0, 0});
  add_ball(model, "b", {0.15, 0, 1}, {19, 0, 0});
  EXPECT_TRUE(approaches_of(model).empty());
  model.bodies[1].velocity.x() = -20;
  const auto found = approaches_of(model);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].approach, 0.4, rounding);
}

TEST(Approaches, to_a_floor_are_by_the_speed_towards_it) {
  for (const bool is_plane : {true, false}) {
    model::Model model;
    const int ball = add_ball(model, "ball", {0, 0, 0.1}, {30, 0, -1});
    if (is_plane) {
      support::add_ground(model);
    } else {
      const int wall = add_wall(model, 0, 10);
      model.geoms.back().body = model::no_body;
      model.geoms.back().local.position = {0, 0, -1};
      model.bodies.resize(static_cast<std::size_t>(wall));
    }
    EXPECT_TRUE(approaches_of(model).empty()) << "rolling";
    model.bodies[static_cast<std::size_t>(ball)].velocity.z() = -12;
    const auto found = approaches_of(model);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].body_b, model::no_body);
    EXPECT_NEAR(found[0].approach, 0.12, rounding);
  }
}

// One for each pair of bodies, the same in a world cut into groups, of which each knows only what moves far.
TEST(Approaches, are_the_same_across_groups) {
  const model::Model model = converging_balls();
  const model::State state = model::initial_state(model);
  const auto whole = approaches_of(model);
  EXPECT_GT(whole.size(), 12u);
  std::vector<int> group;
  for (int body = 0; body < model.num_bodies(); ++body) group.push_back(body % 3);
  const auto bodies_of_group = [&](int own) {
    std::vector<int> bodies;
    for (int body = 0; body < model.num_bodies(); ++body) {
      if (group[body] == own) bodies.push_back(body);
    }
    return bodies;
  };
  std::vector<model::Contact> parts;
  for (int own = 0; own < 3; ++own) {
    FastBodies fast(model, 0.05);
    fast.choose(bodies_of_group(own));
    fast.look(state, dt_s);
    fast.add(state, all, parts);
  }
  FastBodies across(model, 0.05);
  across.look(state, dt_s);
  across.add_across(state, group, parts);
  std::erase_if(parts, [](const model::Contact& contact) { return !contact.is_approach(); });
  std::sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.geoms < b.geoms; });
  ASSERT_EQ(parts.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(parts[i].geoms, whole[i].geoms);
    EXPECT_EQ(parts[i].approach, whole[i].approach);
  }
}

TEST(FastBodies, of_some_bodies_see_these_and_static_geoms_only) {
  const model::Model model = converging_balls();
  const model::State state = model::initial_state(model);
  std::vector<int> some;
  for (int body = 0; body < model.num_bodies(); body += 2) some.push_back(body);
  const auto is_seen = [&](int geom) {
    return model.geoms[geom].body == model::no_body || model.geoms[geom].body % 2 == 0;
  };
  FastBodies fast(model);
  fast.choose(some);
  std::vector<model::Contact> found;
  ASSERT_TRUE(fast.look(state, dt_s));
  for (const int body : fast.bodies()) EXPECT_EQ(body % 2, 0);
  fast.add(state, all, found);
  expect_same(found, contacts_of(model, [&](int a, int b) { return is_seen(a) && is_seen(b); }));
  EXPECT_FALSE(found.empty());
}

TEST(FastBodies, tell_their_bodies_and_slow_ones_not) {
  model::Model model;
  add_ball(model, "slow", {0, 0, 1}, {1, 0, 0});
  add_ball(model, "fast", {0, 5, 1}, {50, 0, 0});
  FastBodies fast(model);
  ASSERT_TRUE(fast.look(model::initial_state(model), dt_s));
  EXPECT_EQ(fast.bodies(), std::vector<int>{1});
  EXPECT_FALSE(fast.look(model::initial_state(model), dt_s / 10)) << "of a shorter step it is no more";
}

}  // namespace
}  // namespace pbmpi::effects
