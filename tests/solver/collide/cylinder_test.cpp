/// The kernels that collide cylinders: touching and depth are tested by an oracle that searches many
/// directions, the points by what rests on what.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/names.h"
#include "model/state.h"
#include "ode/collide/narrow_phase.h"
#include "ode/objects/engine.h"
#include "solver/collide/geom_pairs.h"
#include "solver/collide/overlap.h"
#include "solver/layout/articulation.h"
#include "solver/pack/pack.h"
#include "solver/pack/simd.h"
#include "solver/sor_run.h"

namespace pbmpi::solver {
namespace {

using model::Contact;
using model::Shape;
using model::Vec3;

/// One cylinder and another geom, in many poses.
class Pairs {
 public:
  Pairs(Shape other, int num_worlds, stepping::Simd simd, stepping::Precision precision) {
    Dice dice(29);
    for (int w = 0; w < num_worlds; ++w) models_.push_back(make_model({Shape::cylinder, other}, dice));
    std::vector<PackedWorld> packed;
    for (const model::Model& model : models_) {
      fallbacks_.push_back(ode::make_narrow_phase(model));
      packed.push_back({&model, find_articulations(model), fallbacks_.back().get()});
    }
    pack_ = make_pack(packed, simd, precision);
    contacts_.resize(models_.size());
    ode_.resize(models_.size());
  }

  int size() const { return static_cast<int>(models_.size()); }
  void throw_dice(Dice& dice) {
    for (int w = 0; w < size(); ++w) {
      model::State state = model::initial_state(models_[at(w)]);
      for (std::size_t i = 0; i < 2; ++i) {
        state.position[i] = dice.in_cube(0.7);
        state.orientation[i] = rotation(dice);
      }
      pack_->load(w, state);
    }
    pack_->collide(contacts_);
  }
  const std::vector<Contact>& contacts(int world) const { return contacts_[at(world)]; }
  PlacedGeom geom(int world, int index) const {
    std::vector<model::BodyPose> poses(2);
    pack_->poses(world, poses);
    const model::BodyPose& pose = poses[at(index)];
    PlacedGeom placed{models_[at(world)].geoms[at(index)], Vec3(pose.position), {}};
    for (int i = 0; i < 9; ++i) placed.rotation(i / 3, i % 3) = pose.rotation[i];
    return placed;
  }
  const std::vector<Contact>& of_ode(int world) {
    std::vector<model::BodyPose> poses(2);
    pack_->poses(world, poses);
    const model::GeomPair pair{0, 1};
    std::vector<Contact>& contacts = ode_[at(world)];
    contacts.clear();
    fallbacks_[at(world)]->collide(poses, {&pair, 1}, contacts);
    return contacts;
  }

 private:
  static std::size_t at(int index) { return static_cast<std::size_t>(index); }
  /// Any rotation, or by a multiple of 45 degrees, with or without a slight tilt.
  static model::Quat rotation(Dice& dice) {
    if (dice() < 0.5) return dice.rotation();
    const double turn = std::floor(dice.between(0, 4)) * 0.39269908169872414;
    double q[4] = {std::cos(turn), 0, 0, 0};
    q[1 + static_cast<int>(dice.between(0, 3))] = std::sin(turn);
    const double tilt = dice() < 0.5 ? 0 : std::pow(10.0, -dice.between(1, 12));
    for (double& x : q) x += tilt * dice.between(-1, 1);
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return {q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm};
  }

  ode::Engine engine_;
  std::vector<model::Model> models_;
  std::vector<std::unique_ptr<model::NarrowPhase>> fallbacks_;
  std::unique_ptr<Pack> pack_;
  std::vector<std::vector<Contact>> contacts_, ode_;
};

double deepest(const std::vector<Contact>& contacts) {
  double depth = -1;
  for (const Contact& contact : contacts) depth = std::max(depth, contact.depth);
  return depth;
}

class Cylinder : public testing::TestWithParam<Shape> {};

constexpr double huge_m = 1e9;

/// The bounds tested for one precision.
struct Bounds {
  double verdict_m;  ///< closer to touching than this either verdict is accepted
  double overlap_m;
};

void expect_true_contacts(Shape other, stepping::Precision precision, const Bounds& bounds) {
  Pairs pairs(other, 200, stepping::Simd::automatic, precision);
  Dice dice(31);
  int touching = 0, too_deep = 0;
  for (int round = 0; round < 10; ++round) {
    pairs.throw_dice(dice);
    for (int world = 0; world < pairs.size(); ++world) {
      const PlacedGeom a = pairs.geom(world, 0), b = pairs.geom(world, 1);
      const std::vector<Contact>& contacts = pairs.contacts(world);
      const double along = contacts.empty() ? huge_m : overlap_along(a, b, contacts[0].normal);
      const double least = std::min(least_overlap(a, b), along);
      SCOPED_TRACE(testing::Message() << "world " << world << " round " << round << " overlap " << least);
      if (contacts.empty() || least < 0) {
        ASSERT_LT(contacts.empty() ? least : -least, bounds.verdict_m);
        continue;
      }
      ++touching;
      ASSERT_NEAR(contacts[0].normal.norm(), 1, bounds.overlap_m);
      if (along > 1.01 * least + bounds.overlap_m) ++too_deep;
      // No point is deeper, and the deepest is nearly as deep as the solids overlap along the axis.
      ASSERT_LE(deepest(contacts), along + bounds.overlap_m);
      ASSERT_GE(deepest(contacts), 0.8 * least - bounds.overlap_m);
      ASSERT_LE(contacts.size(), 4u);
      for (const Contact& contact : contacts) {
        ASSERT_EQ(contact.normal, contacts[0].normal);
        ASSERT_GE(contact.depth, 0);
        // Halfway between two surfaces whose features are slightly tilted against each other.
        const double outside =
            std::max(distance_outside(a, contact.position), distance_outside(b, contact.position));
        if (along <= 1.01 * least) {
          ASSERT_LE(outside, 0.6 * along + bounds.overlap_m);
        }
      }
    }
  }
  EXPECT_GT(touching, 400) << "too few pairs touch to say much";
  // Deep inside there are more axes of locally least overlap than the kernels test.
  EXPECT_LE(too_deep, touching / 100);
}

TEST_P(Cylinder, touches_what_it_overlaps_along_the_axis_of_least_overlap) {
  expect_true_contacts(GetParam(), stepping::Precision::double_, {1e-6, 1e-6});
}

TEST_P(Cylinder, touches_the_same_in_single_precision) {
  expect_true_contacts(GetParam(), stepping::Precision::single, {1e-5, 1e-4});
}

// For spheres the two agree. For boxes dCollide tests fewer axes, so that some poses touch for only one of
// the two, and others have another normal. Capsules and cylinders it leaves to libccd, whose normal is that
// of a portal, along which they overlap more.
TEST_P(Cylinder, agrees_with_dcollide_as_far_as_that_is_exact) {
  const bool exact = GetParam() == Shape::sphere, box = GetParam() == Shape::box;
  Pairs pairs(GetParam(), 500, stepping::Simd::automatic, stepping::Precision::double_);
  Dice dice(37);
  int both = 0, one = 0, same = 0, deeper = 0;
  for (int round = 0; round < 20; ++round) {
    pairs.throw_dice(dice);
    for (int world = 0; world < pairs.size(); ++world) {
      const std::vector<Contact>&own = pairs.contacts(world), &ode = pairs.of_ode(world);
      if (own.empty() || ode.empty()) {
        one += own.empty() == ode.empty() ? 0 : 1;
        continue;
      }
      ++both;
      const double difference = deepest(own) - deepest(ode);
      if (own[0].normal.dot(ode[0].normal) > 0.999 && std::abs(difference) < 1e-3) ++same;
      if (difference > 1e-3) ++deeper;
    }
  }
  EXPECT_GT(both, 2000) << "too few pairs touch to say much";
  EXPECT_GE(same, exact ? both : (box ? 17 * both / 20 : both / 5));
  EXPECT_LE(one, box ? both / 10 : 0);
  if (!box) {
    EXPECT_LE(deeper, both / 1000);
  }
}

TEST_P(Cylinder, has_the_same_contacts_in_every_width) {
  for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
    Pairs one_lane(GetParam(), 61, stepping::Simd::off, precision);
    Dice dice(41);
    one_lane.throw_dice(dice);
    for (const stepping::Simd simd : machine_simds()) {
      Pairs wide(GetParam(), 61, simd, precision);
      Dice same_dice(41);
      wide.throw_dice(same_dice);
      for (int world = 0; world < wide.size(); ++world) {
        const std::vector<Contact>&narrow = one_lane.contacts(world), &own = wide.contacts(world);
        ASSERT_EQ(own.size(), narrow.size()) << world;
        for (std::size_t i = 0; i < own.size(); ++i) {
          ASSERT_EQ(own[i].position, narrow[i].position) << world;
          ASSERT_EQ(own[i].normal, narrow[i].normal) << world;
          ASSERT_EQ(own[i].depth, narrow[i].depth) << world;
        }
      }
    }
  }
}

/// Contacts of `moving` at `pose` on `other` at the origin.
std::vector<Contact> contacts_at(const model::Geom& moving, const model::Pose& pose,
                                 const model::Geom& other) {
  const ode::Engine engine;
  return contacts_of(moving, pose, other);
}

/// A rotation about x, y or z.
model::Quat turned(int axis, double angle) {
  double q[4] = {std::cos(angle / 2), 0, 0, 0};
  q[1 + axis] = std::sin(angle / 2);
  return {q[0], q[1], q[2], q[3]};
}

constexpr double right_angle = std::numbers::pi / 2;

double width_of(const std::vector<Contact>& contacts, int axis) {
  double low = 1e9, high = -1e9;
  for (const Contact& contact : contacts) {
    low = std::min(low, contact.position[axis]);
    high = std::max(high, contact.position[axis]);
  }
  return high - low;
}

void expect_all(const std::vector<Contact>& contacts, double depth, const Vec3& normal) {
  for (const Contact& contact : contacts) {
    EXPECT_NEAR(contact.depth, depth, 1e-9);
    EXPECT_NEAR((contact.normal - normal).norm(), 0, 1e-9);
  }
}

const model::Geom wheel = geom_of(Shape::cylinder, 0, {0.5, 0.2, 0});
const model::Geom fixed_wheel = geom_of(Shape::cylinder, model::no_body, {0.5, 0.2, 0});

TEST(CylinderPoints, a_cylinder_that_lies_on_a_box_touches_at_both_ends_of_its_side) {
  for (const double turn : {0.0, 0.3, 1.0}) {
    const model::Geom log = geom_of(Shape::cylinder, 0, {0.3, 2, 0});
    const double c = std::cos(turn / 2), s = std::sin(turn / 2), h = std::sqrt(0.5);
    const auto contacts =
        contacts_at(log, {{0.1, 0, 0.79}, {c * h, c * h, s * h, s * h}}, geom_of(Shape::box, 1, {4, 4, 1}));
    ASSERT_EQ(contacts.size(), 2u) << turn;
    expect_all(contacts, 0.01, {0, 0, 1});
    EXPECT_NEAR((contacts[0].position - contacts[1].position).norm(), 2, 1e-9);
  }
}

TEST(CylinderPoints, a_wheel_that_lies_along_an_edge_touches_along_it) {
  // The box stands on an edge, and has one on top along x, as has the wheel its axis.
  const model::Geom box = geom_of(Shape::box, 0, {0.1, 1, 1});
  const double top = std::sqrt(0.5);
  model::Geom above = fixed_wheel;
  above.local = {{0, 0, top + 0.49}, turned(1, right_angle)};
  const auto contacts = contacts_at(box, {{0, 0, 0}, turned(0, right_angle / 2)}, above);
  ASSERT_EQ(contacts.size(), 2u);
  expect_all(contacts, 0.01, {0, 0, -1});
  EXPECT_NEAR(width_of(contacts, 0), 0.1, 1e-9);
  for (const Contact& contact : contacts) EXPECT_NEAR(contact.position.z(), top - 0.005, 1e-9);
}

TEST(CylinderPoints, a_cylinder_that_stands_on_a_box_touches_at_four_points_of_its_rim) {
  const auto contacts = contacts_at(wheel, {{0.3, -0.2, 0.59}, {}}, geom_of(Shape::box, 1, {4, 4, 1}));
  ASSERT_EQ(contacts.size(), 4u);
  expect_all(contacts, 0.01, {0, 0, 1});
  EXPECT_NEAR(width_of(contacts, 0), 1, 1e-9);
  EXPECT_NEAR(width_of(contacts, 1), 1, 1e-9);
}

TEST(CylinderPoints, a_cylinder_that_stands_half_over_an_edge_is_held_up_to_the_edge) {
  // The box ends at x = 2.
  const auto contacts = contacts_at(wheel, {{2, 0, 0.59}, {}}, geom_of(Shape::box, 1, {4, 4, 1}));
  ASSERT_EQ(contacts.size(), 4u);
  expect_all(contacts, 0.01, {0, 0, 1});
  double last = 0;
  for (const Contact& contact : contacts) last = std::max(last, contact.position.x());
  EXPECT_NEAR(last, 2, 1e-6);
  EXPECT_NEAR(width_of(contacts, 1), 1, 1e-6);
}

TEST(CylinderPoints, a_small_box_on_a_cylinders_end_touches_at_its_corners) {
  const auto contacts = contacts_at(geom_of(Shape::box, 0, {0.4, 0.5, 0.2}), {{0, 0, 0.19}, {}}, fixed_wheel);
  ASSERT_EQ(contacts.size(), 4u);
  expect_all(contacts, 0.01, {0, 0, 1});
  EXPECT_NEAR(width_of(contacts, 0), 0.4, 1e-9);
  EXPECT_NEAR(width_of(contacts, 1), 0.5, 1e-9);
}

TEST(CylinderPoints, a_cylinder_stands_on_another_on_four_points_wherever_they_overlap) {
  for (const double offset : {0.0, 0.2, 0.6}) {
    const auto contacts = contacts_at(wheel, {{offset, 0, 0.19}, {}}, fixed_wheel);
    ASSERT_EQ(contacts.size(), 4u) << offset;
    expect_all(contacts, 0.01, {0, 0, 1});
    // The lens shared by two circles of radius 0.5; eight points of a rim are tested.
    EXPECT_NEAR(width_of(contacts, 0), 1 - offset, 0.15) << offset;
    EXPECT_NEAR(width_of(contacts, 1), 2 * std::sqrt(0.25 - offset * offset / 4), 0.15) << offset;
  }
}

TEST(CylinderPoints, parallel_cylinders_side_by_side_touch_at_both_ends_of_what_they_share) {
  const model::Geom log = geom_of(Shape::cylinder, 0, {0.3, 2, 0});
  const model::Geom other = geom_of(Shape::cylinder, model::no_body, {0.2, 2, 0});
  const auto contacts = contacts_at(log, {{0.49, 0, 0.5}, {}}, other);
  ASSERT_EQ(contacts.size(), 2u);
  expect_all(contacts, 0.01, {1, 0, 0});
  EXPECT_NEAR(width_of(contacts, 2), 1.5, 1e-9);
}

TEST(CylinderPoints, crossed_cylinders_touch_at_one_point) {
  const model::Geom log = geom_of(Shape::cylinder, 0, {0.3, 2, 0});
  const model::Geom other = geom_of(Shape::cylinder, model::no_body, {0.2, 2, 0});
  const auto contacts = contacts_at(log, {{0.49, 0, 0.5}, turned(0, right_angle)}, other);
  ASSERT_EQ(contacts.size(), 1u);
  expect_all(contacts, 0.01, {1, 0, 0});
  EXPECT_NEAR((contacts[0].position - Vec3(0.195, 0, 0.5)).norm(), 0, 1e-9);
}

TEST(CylinderPoints, a_capsule_lies_on_a_cylinders_end_and_beside_its_side_on_two_points) {
  const model::Geom capsule = geom_of(Shape::capsule, 0, {0.1, 0.6, 0});
  const auto on_end = contacts_at(capsule, {{0, 0, 0.19}, turned(1, right_angle)}, fixed_wheel);
  ASSERT_EQ(on_end.size(), 2u);
  expect_all(on_end, 0.01, {0, 0, 1});
  EXPECT_NEAR(width_of(on_end, 0), 0.6, 1e-9);
  const auto beside = contacts_at(capsule, {{0, 0.59, 0}, {}}, fixed_wheel);
  ASSERT_EQ(beside.size(), 2u);
  expect_all(beside, 0.01, {0, 1, 0});
  EXPECT_NEAR(width_of(beside, 2), 0.2, 1e-9);
}

/// Counts the pairs that are left to ODE.
class CountingPhase : public model::NarrowPhase {
 public:
  void collide(std::span<const model::BodyPose>, std::span<const model::GeomPair> pairs,
               std::vector<Contact>&) override {
    asked += static_cast<int>(pairs.size());
  }
  int asked = 0;
};

// All scenes consist of these shapes, and hulls have a narrow phase of their own, so no pair goes to ODE.
TEST(Kernels, no_pair_of_shapes_is_left_to_dcollide) {
  for (int first = 0; first < model::num_shapes; ++first) {
    for (int second = 0; second < model::num_shapes; ++second) {
      const auto a = static_cast<Shape>(first), b = static_cast<Shape>(second);
      if (a == Shape::plane && b == Shape::plane) continue;  // both static: never a pair
      const bool has_surface = a == Shape::hull || a == Shape::mesh || b == Shape::hull || b == Shape::mesh;
      if (has_surface) continue;
      Dice dice(43);
      model::Model model = make_model({a, b}, dice);
      for (model::Geom& geom : model.geoms) geom.local = {};  // all at the origin, a plane through it
      CountingPhase counting;
      PackedWorld world{&model, find_articulations(model), &counting};
      for (const bool lanes : {true, false}) {
        world.lanes_collide = lanes;
        counting.asked = 0;
        const auto pack = make_pack({&world, 1}, stepping::Simd::automatic, stepping::Precision::double_);
        std::vector<Contact> contacts;
        pack->collide({&contacts, 1});
        EXPECT_EQ(contacts.empty(), !lanes) << name_of(a) << " and " << name_of(b);
        EXPECT_EQ(counting.asked, lanes ? 0 : 1) << name_of(a) << " and " << name_of(b);
      }
    }
  }
}

std::string shape_name(const testing::TestParamInfo<Shape>& info) {
  return "and_" + std::string(name_of(info.param));
}

INSTANTIATE_TEST_SUITE_P(EveryShape, Cylinder,
                         testing::Values(Shape::sphere, Shape::capsule, Shape::box, Shape::cylinder),
                         shape_name);

}  // namespace
}  // namespace pbmpi::solver
