#include "solver/collide/broad_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.h"
#include "geometry/geometry.h"
#include "model/state.h"
#include "support/body_poses.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::GeomPair;

/// Loose geoms of all shapes in a cube over the ground.
model::Model cloud(int count, double side) {
  model::Model model;
  support::add_ground(model);
  for (int i = 0; i < count; ++i) {
    const auto number = [&](std::uint64_t k) {
      return core::to_unit(core::mix_key(11, static_cast<std::uint64_t>(i), k));
    };
    const auto shape = static_cast<model::Shape>(i % 4);
    const int actor =
        support::add_actor(model, "solid" + std::to_string(i / 3));  // three geoms of one actor never touch
    support::add_solid(model, actor, "body" + std::to_string(i), shape,
                       {0.2 + 0.3 * number(0), 0.3 + 0.4 * number(1), 0.4}, 1,
                       {side * number(2), side * number(3), side * number(4)},
                       support::rotation(model::Vec3(number(5), number(6), 1).normalized(), 6 * number(7)));
  }
  return model;
}

using Poses = std::vector<model::BodyPose>;

BroadPhase broad_phase_of_all(const model::Model& model) {
  return BroadPhase(model, support::all_geoms(model));
}

/// `geoms`: those of the broad phase.
std::vector<GeomPair> pairs_of(BroadPhase& broad_phase, const model::Model& model,
                               const std::vector<int>& geoms, const Poses& poses,
                               const AwakeGeoms* awake = nullptr) {
  std::vector<geometry::Box> boxes;
  for (const int index : geoms) {
    const model::Geom& geom = model.geoms[static_cast<std::size_t>(index)];
    const bool is_static = geom.body == model::no_body;
    boxes.push_back(geom.shape == model::Shape::plane
                        ? geometry::Box()
                        : geometry::geom_box(geom, is_static ? geometry::static_pose()
                                                             : poses[static_cast<std::size_t>(geom.body)]));
  }
  std::vector<GeomPair> pairs;
  broad_phase.append_pairs(boxes, awake, pairs);
  return pairs;
}

std::vector<GeomPair> pairs_of(BroadPhase& broad_phase, const model::Model& model, const Poses& poses) {
  return pairs_of(broad_phase, model, support::all_geoms(model), poses);
}

/// Every pair of geoms, tested by the rules in the header.
std::vector<GeomPair> brute_force(const model::Model& model, const Poses& poses) {
  std::vector<GeomPair> pairs;
  for (int i = 0; i < static_cast<int>(model.geoms.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(model.geoms.size()); ++j) {
      const model::Geom& a = model.geoms[static_cast<std::size_t>(i)];
      const model::Geom& b = model.geoms[static_cast<std::size_t>(j)];
      if (a.body == b.body || a.actor == b.actor) continue;
      const model::BodyPose pose_b = geometry::geom_pose(b, poses[static_cast<std::size_t>(b.body)]);
      const auto half_b = geometry::half_extents(b, pose_b.rotation);
      bool touch = true;
      if (a.shape == model::Shape::plane) {
        touch = pose_b.position[2] - half_b[2] <= 0;  // the ground z = 0
      } else {
        const model::BodyPose pose_a = geometry::geom_pose(a, poses[static_cast<std::size_t>(a.body)]);
        const auto half_a = geometry::half_extents(a, pose_a.rotation);
        for (std::size_t k = 0; k < 3; ++k) {
          touch = touch && std::abs(pose_a.position[k] - pose_b.position[k]) <= half_a[k] + half_b[k];
        }
      }
      if (touch) pairs.push_back({i, j});
    }
  }
  return pairs;
}

TEST(BroadPhase, finds_the_pairs_of_brute_force_in_order) {
  for (const int count : {20, 60, 150, 400}) {
    const model::Model model = cloud(count, std::cbrt(count) * 0.5);
    const auto poses = support::body_poses(model);
    BroadPhase broad_phase = broad_phase_of_all(model);
    const auto pairs = pairs_of(broad_phase, model, poses);
    const auto expected = brute_force(model, poses);
    EXPECT_GT(expected.size(), 10u);
    EXPECT_EQ(pairs, expected) << count;
  }
}

TEST(BroadPhase, leaves_out_the_pairs_of_which_neither_is_awake) {
  for (const int count : {60, 400}) {
    const model::Model model = cloud(count, std::cbrt(count) * 0.5);
    const auto poses = support::body_poses(model);
    const std::vector<int> geoms = support::all_geoms(model);
    BroadPhase broad_phase = broad_phase_of_all(model);
    for (const int one_in : {1, 2, 7, 1000}) {
      ActiveBodies active;
      active.add_world(model.num_bodies());
      std::vector<int> bodies;
      for (int body = 0; body < model.num_bodies(); body += one_in) bodies.push_back(body);
      active.set(0, bodies);
      AwakeGeoms awake(model, geoms, 4);
      awake.find(active, 0);
      const auto pairs = pairs_of(broad_phase, model, geoms, poses, &awake);
      std::vector<GeomPair> expected;
      for (const GeomPair& pair : brute_force(model, poses)) {
        const int a = model.geoms[static_cast<std::size_t>(pair.first)].body,
                  b = model.geoms[static_cast<std::size_t>(pair.second)].body;
        if ((a >= 0 && a % one_in == 0) || (b >= 0 && b % one_in == 0)) expected.push_back(pair);
      }
      EXPECT_EQ(pairs, expected) << count << " bodies, one in " << one_in << " awake";
    }
  }
}

TEST(BroadPhase, of_some_geoms_finds_the_pairs_among_them) {
  const model::Model model = cloud(150, 3);
  const auto poses = support::body_poses(model);
  std::vector<int> some;
  for (int geom = 0; geom < static_cast<int>(model.geoms.size()); geom += 2) some.push_back(geom);
  BroadPhase broad_phase(model, some);
  const auto pairs = pairs_of(broad_phase, model, some, poses);
  std::vector<GeomPair> expected;
  for (const GeomPair& pair : brute_force(model, poses)) {
    if (pair.first % 2 == 0 && pair.second % 2 == 0) expected.push_back(pair);
  }
  EXPECT_GT(expected.size(), 10u);
  EXPECT_EQ(pairs, expected);
}

// In some steps few bodies move, in others all, by less than their rooms or by more.
TEST(BroadPhase, the_history_of_the_boxes_does_not_matter) {
  const model::Model model = cloud(150, 3);
  auto poses = support::body_poses(model);
  BroadPhase travelled = broad_phase_of_all(model);
  for (int step = 0; step < 40; ++step) {
    const double way = step % 3 == 0 ? 0.1 : 0.004;
    for (std::size_t i = 0; i < poses.size(); i += step % 5 == 0 ? 10 : 1) {
      for (int k = 0; k < 3; ++k)
        poses[i].position[k] += way * (core::to_unit(core::mix_key(i, static_cast<std::uint64_t>(k),
                                                                   static_cast<std::uint64_t>(step))) -
                                       0.5);
    }
    BroadPhase fresh = broad_phase_of_all(model);
    ASSERT_EQ(pairs_of(travelled, model, poses), pairs_of(fresh, model, poses)) << step;
    ASSERT_EQ(pairs_of(travelled, model, poses), brute_force(model, poses)) << step;
  }
}

TEST(BroadPhase, a_body_that_is_nowhere_pairs_with_none_until_it_is_back) {
  const model::Model model = cloud(60, 2);
  const auto poses = support::body_poses(model);
  BroadPhase broad_phase = broad_phase_of_all(model);
  const auto before = pairs_of(broad_phase, model, poses);
  auto lost = poses;
  lost[7].position[1] = std::numeric_limits<double>::quiet_NaN();
  std::vector<GeomPair> expected = before;
  std::erase_if(expected, [](const GeomPair& pair) { return pair.first == 8 || pair.second == 8; });
  EXPECT_LT(expected.size(), before.size());
  EXPECT_EQ(pairs_of(broad_phase, model, lost), expected);
  EXPECT_EQ(pairs_of(broad_phase, model, poses), before);
}

// Sorting along one axis and looking at all that overlap along it would not end.
TEST(BroadPhase, of_many_bodies_in_columns_beside_a_large_one_ends) {
  constexpr int side = 400;
  model::Model model;
  support::add_ground(model);
  for (int i = 0; i < side * side; ++i) {
    const int actor = support::add_actor(model, "");
    support::add_solid(model, actor, "", model::Shape::box, {1, 1, 1}, 1,
                       {1.5 * (i % 2), 1.5 * (i / 2 % side), 1.5 * (i / 2 / side) + 0.5});  // NOLINT
  }
  const int roof = support::add_actor(model, "roof");
  support::add_solid(model, roof, "roof", model::Shape::box, {3, 600, 300}, 1, {0, 300, 350});
  auto poses = support::body_poses(model);
  BroadPhase broad_phase = broad_phase_of_all(model);
  for (int step = 0; step < 10; ++step) {
    for (model::BodyPose& pose : poses) pose.position[1] += 0.1;
    const auto pairs = pairs_of(broad_phase, model, poses);
    EXPECT_GT(pairs.size(), 50'000u) << "a third of all are beside it";
    EXPECT_TRUE(std::ranges::is_sorted(pairs));
  }
}

TEST(BroadPhase, bodies_that_share_a_joint_do_not_pair) {
  model::Model model;
  const int first = support::add_actor(model, "first"), second = support::add_actor(model, "second");
  const int a = support::add_solid(model, first, "a", model::Shape::box, {1, 1, 1}, 1, {0, 0, 0});
  const int b = support::add_solid(model, second, "b", model::Shape::box, {1, 1, 1}, 1, {0.5, 0, 0});
  const auto poses = support::body_poses(model);
  BroadPhase before = broad_phase_of_all(model);
  EXPECT_EQ(pairs_of(before, model, poses), (std::vector<GeomPair>{{0, 1}}));
  support::add_joint(model, model::JointKind::ball, a, b, {0.25, 0, 0});
  BroadPhase after = broad_phase_of_all(model);
  EXPECT_TRUE(pairs_of(after, model, poses).empty());
  const std::int32_t broken = 3;
  after.set_broken({&broken, 1});
  EXPECT_EQ(pairs_of(after, model, poses), (std::vector<GeomPair>{{0, 1}}));
}

}  // namespace
}  // namespace pbmpi::solver
