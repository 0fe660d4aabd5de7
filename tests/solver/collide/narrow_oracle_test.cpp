/// The kernels over lanes against ODE's dCollide, on a million random pairs in all. One file: each pair of
/// shapes has its own degenerate cases, and all share the generator of pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/random.h"
#include "geometry/geometry.h"
#include "model/names.h"
#include "ode/collide/narrow_phase.h"
#include "ode/objects/engine.h"
#include "solver/collide/geom_pairs.h"
#include "solver/layout/articulation.h"
#include "solver/pack/pack.h"
#include "solver/pack/simd.h"

namespace pbmpi::solver {
namespace {

using model::Contact;
using model::Shape;
using model::Vec3;
using Kind = ShapePair;

constexpr int num_worlds = 500;
constexpr int rounds = 225;  // x 500 pairs x 9 kinds: just over a million

class NarrowOracle : public testing::TestWithParam<Kind> {
 protected:
  NarrowOracle() {
    Dice dice(17);
    for (int w = 0; w < num_worlds; ++w) models_.push_back(make_model(GetParam(), dice));
    std::vector<PackedWorld> packed;
    for (const model::Model& model : models_) {
      fallbacks_.push_back(ode::make_narrow_phase(model));
      packed.push_back({&model, find_articulations(model), fallbacks_.back().get()});
    }
    pack_ = make_pack(packed, stepping::Simd::automatic, stepping::Precision::double_);
  }

  /// Gives a world random poses; returns its contacts according to ODE.
  void throw_dice(int world, Dice& dice, std::vector<Contact>& ode) {
    const model::Model& model = models_[static_cast<std::size_t>(world)];
    model::State state = model::initial_state(model);
    std::vector<model::BodyPose> poses(2);
    for (std::size_t i = 0; i < 2; ++i) {
      state.position[i] = dice.in_cube(0.7);
      state.orientation[i] = dice.rotation();
    }
    pack_->load(world, state);
    pack_->poses(world, poses);
    const model::GeomPair pair{0, 1};
    ode.clear();
    fallbacks_[static_cast<std::size_t>(world)]->collide(poses, {&pair, 1}, ode);
  }

  ode::Engine engine_;
  std::vector<model::Model> models_;
  std::vector<std::unique_ptr<model::NarrowPhase>> fallbacks_;
  std::unique_ptr<Pack> pack_;
};

double deepest(const std::vector<Contact>& contacts) {
  double depth = -1;
  for (const Contact& contact : contacts) depth = std::max(depth, contact.depth);
  return depth;
}

/// Distance from a contact, which lies half way between the surfaces, to the nearest of ODE's, which lie
/// somewhere between them.
double distance_to(const Contact& own, const std::vector<Contact>& contacts) {
  double distance = 1e9;
  for (const Contact& contact : contacts) {
    const Vec3 apart = contact.position - own.position;
    const double between = std::clamp(apart.dot(own.normal), -0.5 * own.depth, 0.5 * own.depth);
    distance = std::min(distance, (apart - between * own.normal).norm());
  }
  return distance;
}

// Closer to touching than this [m] rounding decides the verdict: some 1e-15 of the sizes, enlarged by the
// divisions of edges against edges.
constexpr double band_m = 1e-9;
constexpr double depth_tolerance_m = 1e-6;

/// For a capsule whose segment has entered the box dCollide returns the world's x axis as normal; the kernel
/// looks for the way out (a_capsule_in_a_box_is_led_out).
bool is_capsule_in_box(const model::Model& model, const std::vector<Contact>& oracle) {
  const auto capsule = std::find_if(model.geoms.begin(), model.geoms.end(),
                                    [](const model::Geom& g) { return g.shape == Shape::capsule; });
  const bool box = std::any_of(model.geoms.begin(), model.geoms.end(),
                               [](const model::Geom& g) { return g.shape == Shape::box; });
  return box && capsule != model.geoms.end() && deepest(oracle) > capsule->size[0] - band_m;
}

TEST_P(NarrowOracle, agrees_with_dcollide) {
  Dice dice(4711);
  int touching = 0, other_axis = 0;
  std::vector<std::vector<Contact>> ode(num_worlds), all(num_worlds);
  for (int round = 0; round < rounds; ++round) {
    for (int world = 0; world < num_worlds; ++world)
      throw_dice(world, dice, ode[static_cast<std::size_t>(world)]);
    pack_->collide(all);
    for (int world = 0; world < num_worlds; ++world) {
      const std::vector<Contact>& own = all[static_cast<std::size_t>(world)];
      const std::vector<Contact>& oracle = ode[static_cast<std::size_t>(world)];
      if (own.empty() != oracle.empty()) {
        ASSERT_LT(std::max(deepest(own), deepest(oracle)), band_m) << "world " << world << " round " << round;
        continue;
      }
      if (own.empty()) continue;
      ++touching;
      if (is_capsule_in_box(models_[static_cast<std::size_t>(world)], oracle)) continue;
      // Two boxes may overlap equally along two axes; then either answer is right.
      if (own.front().normal.dot(oracle.front().normal) < 1 - 1e-9) {
        ++other_axis;
        continue;
      }
      ASSERT_EQ(own.front().body_a, oracle.front().body_a);
      ASSERT_NEAR(deepest(own), deepest(oracle), depth_tolerance_m)
          << "world " << world << " round " << round;
      const bool boxes = GetParam().a == Shape::box && GetParam().b == Shape::box;
      if (boxes) {  // with more than four points each keeps those that it expects to span the most
        ASSERT_EQ(own.size() == 1, oracle.size() == 1);
        continue;
      }
      ASSERT_EQ(own.size(), oracle.size()) << "world " << world << " round " << round;
      for (const Contact& contact : own) {
        ASSERT_LT(distance_to(contact, oracle), depth_tolerance_m) << "world " << world << " round " << round;
      }
    }
  }
  EXPECT_GT(touching, rounds * num_worlds / 20) << "too few pairs touch to say much";
  EXPECT_LE(other_axis, touching / 1000);
}

TEST(NarrowLanes, a_box_that_lies_on_a_larger_one_touches_at_its_four_corners) {
  const ode::Engine engine;
  const auto contacts = contacts_of(geom_of(Shape::box, 0, {1, 2, 0.5}), {{0.1, 0, 0.74}, {}},
                                    geom_of(Shape::box, 1, {4, 4, 1}));
  ASSERT_EQ(contacts.size(), 4u);
  for (const Contact& contact : contacts) {
    EXPECT_NEAR(contact.depth, 0.01, 1e-12);
    EXPECT_NEAR(std::abs(contact.position.x() - 0.1), 0.5, 1e-12);
    EXPECT_NEAR(std::abs(contact.position.y()), 1, 1e-12);
    EXPECT_EQ(contact.normal, Vec3(0, 0, 1));
  }
}

TEST(NarrowLanes, a_wheel_stands_on_two_points_and_a_cylinder_on_its_end_on_four) {
  const ode::Engine engine;
  const model::Geom wheel = geom_of(Shape::cylinder, 0, {0.5, 0.2, 0}),
                    ground = geom_of(Shape::plane, -1, {});
  const double half = std::sqrt(0.5);
  const auto rolling = contacts_of(wheel, {{0, 0, 0.49}, {half, half, 0, 0}}, ground);
  ASSERT_EQ(rolling.size(), 2u);
  EXPECT_NEAR((rolling[0].position - rolling[1].position).norm(), 0.2, 1e-12);
  EXPECT_NEAR(rolling[0].depth, 0.01, 1e-12);
  const auto standing = contacts_of(wheel, {{0, 0, 0.09}, {}}, ground);
  ASSERT_EQ(standing.size(), 4u);
  for (const Contact& contact : standing) {
    EXPECT_NEAR(contact.depth, 0.01, 1e-12);
    EXPECT_NEAR(std::hypot(contact.position.x(), contact.position.y()), 0.5, 1e-12);
  }
}

TEST(NarrowLanes, a_cylinder_is_as_deep_in_a_plane_as_dcollide_says) {
  const ode::Engine engine;
  Dice dice(5);
  int touching = 0;
  for (int i = 0; i < 2000; ++i) {
    const Kind kind{Shape::cylinder, Shape::plane};
    const model::Model model = make_model(kind, dice);
    const model::Pose pose{dice.in_cube(0.7), dice.rotation()};
    const auto own = contacts_of(model.geoms[0], pose, model.geoms[1]);
    const model::BodyPose poses[] = {geometry::body_pose(pose), geometry::static_pose()};
    std::vector<Contact> oracle;
    const model::GeomPair pair{0, 1};
    ode::make_narrow_phase(model)->collide(poses, {&pair, 1}, oracle);
    if (own.empty() != oracle.empty()) {
      ASSERT_LT(std::max(deepest(own), deepest(oracle)), band_m) << i;
      continue;
    }
    touching += own.empty() ? 0 : 1;
    ASSERT_NEAR(deepest(own), deepest(oracle), depth_tolerance_m) << i;
  }
  EXPECT_GT(touching, 200);
}

/// Pushed along its contacts' normals by their depths, a capsule leaves a box, wherever it began.
void expect_led_out(stepping::Precision precision, double tolerance_m) {
  const ode::Engine engine;
  Dice dice(23);
  int entered = 0;
  for (int i = 0; i < 1000; ++i) {
    const model::Model model = make_model({Shape::capsule, Shape::box}, dice);
    model::Pose pose{dice.in_cube(0.4), dice.rotation()};
    auto contacts = contacts_of(model.geoms[0], pose, model.geoms[1], precision);
    if (deepest(contacts) < model.geoms[0].size[0]) continue;
    ++entered;
    for (int push = 0; push < 12 && deepest(contacts) > tolerance_m; ++push) {
      ASSERT_EQ(contacts.size(), 1u);
      ASSERT_NEAR(contacts[0].normal.norm(), 1, tolerance_m);
      const double side = contacts[0].body_a == 0 ? 1 : -1;
      pose.position += side * contacts[0].depth * contacts[0].normal;
      contacts = contacts_of(model.geoms[0], pose, model.geoms[1], precision);
    }
    ASSERT_LE(deepest(contacts), tolerance_m) << i;
  }
  EXPECT_GT(entered, 200) << "too few capsules enter to say much";
}

TEST(NarrowLanes, a_capsule_in_a_box_is_led_out) { expect_led_out(stepping::Precision::double_, 1e-9); }

// Positions of about a metre are rounded to 1e-7.
TEST(NarrowLanes, a_capsule_in_a_box_is_led_out_in_single_precision) {
  expect_led_out(stepping::Precision::single, 1e-5);
}

TEST(NarrowLanes, a_capsule_that_lies_flat_in_a_box_is_pushed_at_its_middle_through_the_nearest_face) {
  const ode::Engine engine;
  const double half = std::sqrt(0.5);
  // Along the box's x axis, 0.1 m under its upper face.
  const auto contacts = contacts_of(geom_of(Shape::capsule, 0, {0.05, 0.4, 0}),
                                    {{0.3, 0, 0.4}, {half, 0, half, 0}}, geom_of(Shape::box, 1, {4, 4, 1}));
  ASSERT_EQ(contacts.size(), 1u);
  const double side = contacts[0].body_a == 0 ? 1 : -1;
  EXPECT_NEAR(contacts[0].depth, 0.15, 1e-12);
  EXPECT_NEAR((side * contacts[0].normal - Vec3(0, 0, 1)).norm(), 0, 1e-12);
  EXPECT_NEAR(contacts[0].position.x(), 0.3, 1e-12);
}

std::string kind_name(const testing::TestParamInfo<Kind>& info) {
  return std::string(name_of(info.param.a)) + "_and_" + std::string(name_of(info.param.b));
}

// Some pairs in either order of the shapes, which also tests the turning of normals.
INSTANTIATE_TEST_SUITE_P(EveryKind, NarrowOracle,
                         testing::Values(Kind{Shape::sphere, Shape::plane},
                                         Kind{Shape::plane, Shape::capsule}, Kind{Shape::box, Shape::plane},
                                         Kind{Shape::sphere, Shape::sphere},
                                         Kind{Shape::sphere, Shape::capsule}, Kind{Shape::box, Shape::sphere},
                                         Kind{Shape::capsule, Shape::capsule},
                                         Kind{Shape::capsule, Shape::box}, Kind{Shape::box, Shape::box}),
                         kind_name);

}  // namespace
}  // namespace pbmpi::solver
