#include "ode/collide/broad_phase.h"

#include <gtest/gtest.h>

#include "ode/objects/bodies.h"
#include "ode/objects/engine.h"
#include "support/models.h"

namespace pbmpi::ode {
namespace {

using model::Model;
using model::Shape;

/// A model in ODE with its broad phase.
class Scenery {
 public:
  Scenery(const Model& model, SpaceKind kind)
      : world_(dWorldCreate()), bodies_(make_bodies(world_.get(), model)), broad(model, bodies_, kind) {}

 private:
  Engine engine_;
  WorldHandle world_;
  std::vector<dBodyID> bodies_;

 public:
  BroadPhase broad;
};

bool boxes_overlap(dGeomID a, dGeomID b) {
  dReal box_a[6], box_b[6];
  dGeomGetAABB(a, box_a);
  dGeomGetAABB(b, box_b);
  for (int axis = 0; axis < 3; ++axis) {
    if (box_a[2 * axis] > box_b[2 * axis + 1] || box_b[2 * axis] > box_a[2 * axis + 1]) return false;
  }
  return true;
}

bool joined(const Model& model, int body_a, int body_b) {
  for (const model::Joint& joint : model.joints) {
    if ((joint.body_a == body_a && joint.body_b == body_b) ||
        (joint.body_a == body_b && joint.body_b == body_a)) {
      return true;
    }
  }
  return false;
}

/// All pairs, each tested by the four conditions of the rule.
std::vector<GeomPair> brute_force(const Model& model, const std::vector<dGeomID>& geoms) {
  std::vector<GeomPair> pairs;
  for (int a = 0; a < static_cast<int>(geoms.size()); ++a) {
    for (int b = a + 1; b < static_cast<int>(geoms.size()); ++b) {
      const model::Geom& first = model.geoms[a];
      const model::Geom& second = model.geoms[b];
      const bool both_static = first.body == model::no_body && second.body == model::no_body;
      const bool same_body = first.body == second.body;
      const bool same_actor = first.actor == second.actor && !model.actors[first.actor].self_collision;
      if (both_static || same_body || same_actor || joined(model, first.body, second.body)) continue;
      if (boxes_overlap(geoms[a], geoms[b])) pairs.push_back({a, b});
    }
  }
  return pairs;
}

class BothSpaces : public testing::TestWithParam<SpaceKind> {};
INSTANTIATE_TEST_SUITE_P(BroadPhase, BothSpaces,
                         testing::Values(SpaceKind::simple, SpaceKind::sweep_and_prune));

TEST_P(BothSpaces, find_what_brute_force_finds_in_a_pile) {
  Model model = support::pile(40);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) model.bodies[i].pose.position.z() = 0.2 + 0.1 * i;
  Scenery scenery(model, GetParam());
  const auto& pairs = scenery.broad.find_pairs();
  EXPECT_GT(pairs.size(), 100u);
  EXPECT_EQ(pairs, brute_force(model, scenery.broad.geoms()));
}

TEST_P(BothSpaces, find_what_brute_force_finds_in_the_crash) {
  Model model = support::crash();
  for (int body = 5; body < 37; ++body)
    model.bodies[body].pose.position.x() -= 3.5;  // the ragdolls into the car
  Scenery scenery(model, GetParam());
  const auto& pairs = scenery.broad.find_pairs();
  EXPECT_GT(pairs.size(), 10u);
  EXPECT_EQ(pairs, brute_force(model, scenery.broad.geoms()));
}

TEST_P(BothSpaces, keep_joined_bodies_apart_in_an_actor_that_collides_with_itself) {
  Model model = support::chain(6);
  model.actors[0].self_collision = true;
  for (model::Body& body : model.bodies) body.pose.position.x() *= 0.1;  // all in one heap
  Scenery scenery(model, GetParam());
  const auto pairs = scenery.broad.find_pairs();
  EXPECT_EQ(pairs.size(), 15u - 5u);  // every pair but the neighbours
  EXPECT_EQ(pairs, brute_force(model, scenery.broad.geoms()));
}

TEST_P(BothSpaces, keep_more_actors_apart_than_there_are_category_bits) {
  Model model;
  support::add_ground(model);
  for (int i = 0; i < 50; ++i) {
    const std::string name = "actor" + std::to_string(i);
    const int actor = support::add_actor(model, name);
    for (const char* part : {"a", "b"}) {
      support::add_solid(model, actor, name + part, Shape::sphere, {0.6, 0, 0}, 1, {0.5 * i, 0, 0.5});
    }
  }
  Scenery scenery(model, GetParam());
  const auto& pairs = scenery.broad.find_pairs();
  EXPECT_EQ(pairs, brute_force(model, scenery.broad.geoms()));
  EXPECT_GT(pairs.size(), 200u);
}

TEST_P(BothSpaces, follow_bodies_that_move) {
  Model model = support::pile(8);
  const WorldHandle world(dWorldCreate());
  const Engine engine;
  const auto bodies = make_bodies(world.get(), model);
  BroadPhase broad(model, bodies, GetParam());
  broad.find_pairs();
  model::State state = model::initial_state(model);
  for (int i = 0; i < 8; ++i) state.position[i] = {0.3 * i, 0, 0.2};
  restore(bodies, state);
  const auto& pairs = broad.find_pairs();
  EXPECT_EQ(pairs, brute_force(model, broad.geoms()));
  EXPECT_GT(pairs.size(), 8u);
}

TEST_P(BothSpaces, offer_a_plane_only_what_reaches_into_its_bounding_box) {
  Model model = support::box_over_ground(1);
  EXPECT_EQ(Scenery(model, GetParam()).broad.find_pairs().size(), 0u);
  model.geoms[0].local.orientation = support::rotation(model::Vec3::UnitX(), 0.5);  // its box is infinite
  EXPECT_EQ(Scenery(model, GetParam()).broad.find_pairs().size(), 1u);
}

TEST(BroadPhase, gives_sorted_pairs_of_ordered_geoms) {
  Scenery scenery(support::pile(30), SpaceKind::sweep_and_prune);
  const auto& pairs = scenery.broad.find_pairs();
  EXPECT_TRUE(std::is_sorted(pairs.begin(), pairs.end()));
  for (const GeomPair& pair : pairs) EXPECT_LT(pair.first, pair.second);
}

}  // namespace
}  // namespace pbmpi::ode
