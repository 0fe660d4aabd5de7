/// Contacts that are found before bodies touch (PackedWorld::contact_margin_m).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "model/names.h"
#include "ode/collide/narrow_phase.h"
#include "ode/objects/engine.h"
#include "solver/layout/articulation.h"
#include "solver/pack/pack.h"
#include "solver/pack/simd.h"

namespace pbmpi::solver {
namespace {

using model::Contact;
using model::Shape;
using model::Vec3;

constexpr double margin_m = 0.01;

struct Pair {
  Shape a, b;
};

/// Two geoms, each on a body of its own except for a plane.
model::Model pair_model(const Pair& pair) {
  model::Model model;
  int index = 0;
  for (const Shape shape : {pair.a, pair.b}) {
    model.actors.emplace_back().name = std::to_string(index);
    model::Body& body = model.bodies.emplace_back();
    body.name = std::to_string(index);
    body.actor = index;
    model::Geom& geom = model.geoms.emplace_back();
    geom.shape = shape;
    geom.actor = index;
    geom.body = shape == Shape::plane ? model::no_body : index;
    geom.size = {0.3, 0.5, 0.4};
    ++index;
  }
  return model;
}

/// A pair whose poses a test sets, in a pack with a margin and in a pack without one.
class TwoGeoms {
 public:
  explicit TwoGeoms(const Pair& pair)
      : model_(pair_model(pair)),
        fallback_(ode::make_narrow_phase(model_)),
        ahead_(pack(margin_m)),
        touching_(pack(0)),
        state_(model::initial_state(model_)) {}

  model::State& state() { return state_; }
  std::vector<Contact> contacts_ahead() { return contacts(*ahead_); }
  std::vector<Contact> touching() { return contacts(*touching_); }

 private:
  std::unique_ptr<Pack> pack(double margin) {
    PackedWorld world{&model_, find_articulations(model_), fallback_.get()};
    world.contact_margin_m = margin;
    return make_pack({&world, 1}, stepping::Simd::automatic, stepping::Precision::double_);
  }
  std::vector<Contact> contacts(Pack& pack) {
    pack.load(0, state_);
    std::vector<Contact> found;
    pack.collide({&found, 1});
    return found;
  }

  ode::Engine engine_;
  model::Model model_;
  std::unique_ptr<model::NarrowPhase> fallback_;
  std::unique_ptr<Pack> ahead_, touching_;
  model::State state_;
};

const Contact& deepest(const std::vector<Contact>& contacts) {
  return *std::max_element(contacts.begin(), contacts.end(),
                           [](const Contact& a, const Contact& b) { return a.depth < b.depth; });
}

class ContactMargin : public testing::TestWithParam<Pair> {
 protected:
  void throw_dice(TwoGeoms& geoms) {
    for (std::size_t body = 0; body < 2; ++body) {
      for (int k = 0; k < 3; ++k) geoms.state().position[body][k] = 0.7 * number_(engine_);
      model::Quat& q = geoms.state().orientation[body];
      do {
        q = {number_(engine_), number_(engine_), number_(engine_), number_(engine_)};
      } while (q.to_eigen().norm() < 0.1);
      const double norm = q.to_eigen().norm();
      q = {q.w / norm, q.x / norm, q.y / norm, q.z / norm};
    }
  }

  /// With a margin the boxes may use another axis along which they overlap as little, up to 5 % more.
  static double ratio_of_depths() {
    const bool are_boxes = GetParam().a == Shape::box && GetParam().b == Shape::box;
    return are_boxes ? 1.05 : 1;
  }

 private:
  std::mt19937_64 engine_{11};
  std::uniform_real_distribution<double> number_{-1, 1};
};

TEST_P(ContactMargin, finds_a_gap_of_which_less_can_be_closed_without_touching) {
  TwoGeoms geoms(GetParam());
  int gaps = 0;
  for (int i = 0; i < 20'000; ++i) {
    throw_dice(geoms);
    const std::vector<Contact> ahead = geoms.contacts_ahead(), touching = geoms.touching();
    if (!touching.empty()) {
      ASSERT_FALSE(ahead.empty());
      const double depth = deepest(touching).depth;
      EXPECT_GT(deepest(ahead).depth, depth / ratio_of_depths() - 1e-9);
      EXPECT_LT(deepest(ahead).depth, depth * ratio_of_depths() + 1e-9);
      continue;
    }
    if (ahead.empty()) continue;
    const Contact& nearest = deepest(ahead);
    ASSERT_LE(nearest.depth, 0);
    ASSERT_GE(nearest.depth, -margin_m);
    const int mover = nearest.body_a;
    const Vec3 start = geoms.state().position[mover];
    geoms.state().position[mover] = start + 0.99 * nearest.depth * nearest.normal;
    EXPECT_TRUE(geoms.touching().empty()) << "try " << i;
    ++gaps;
  }
  EXPECT_GT(gaps, 20);
}

/// Touching geoms that are moved apart along their normal have a gap. Boxes and cylinders may then be farther
/// apart along another axis.
TEST_P(ContactMargin, finds_what_was_drawn_apart_by_half_of_it_and_not_by_twice) {
  const auto has_edges = [](Shape shape) { return shape == Shape::box || shape == Shape::cylinder; };
  if (has_edges(GetParam().a) && has_edges(GetParam().b)) GTEST_SKIP() << "they have many axes";
  TwoGeoms geoms(GetParam());
  int drawn = 0;
  for (int i = 0; i < 20'000; ++i) {
    throw_dice(geoms);
    const std::vector<Contact> touching = geoms.touching();
    if (touching.empty() || deepest(touching).depth > 0.1) continue;
    const Contact contact = deepest(touching);
    const Vec3 start = geoms.state().position[contact.body_a];
    geoms.state().position[contact.body_a] = start + (contact.depth + margin_m / 2) * contact.normal;
    const std::vector<Contact> near = geoms.contacts_ahead();
    ASSERT_FALSE(near.empty()) << "try " << i;
    EXPECT_NEAR(deepest(near).depth, -margin_m / 2, 2e-3);  // round shapes turn their normal slightly
    geoms.state().position[contact.body_a] = start + (contact.depth + 2 * margin_m) * contact.normal;
    EXPECT_TRUE(geoms.contacts_ahead().empty() || deepest(geoms.contacts_ahead()).depth >= -margin_m);
    ++drawn;
  }
  EXPECT_GT(drawn, 100);
}

std::string pair_name(const testing::TestParamInfo<Pair>& info) {
  return std::string(name_of(info.param.a)) + "_" + std::string(name_of(info.param.b));
}

INSTANTIATE_TEST_SUITE_P(
    EveryKind, ContactMargin,
    testing::Values(Pair{Shape::sphere, Shape::plane}, Pair{Shape::capsule, Shape::plane},
                    Pair{Shape::box, Shape::plane}, Pair{Shape::cylinder, Shape::plane},
                    Pair{Shape::sphere, Shape::sphere}, Pair{Shape::capsule, Shape::sphere},
                    Pair{Shape::sphere, Shape::box}, Pair{Shape::capsule, Shape::capsule},
                    Pair{Shape::capsule, Shape::box}, Pair{Shape::box, Shape::box},
                    Pair{Shape::cylinder, Shape::sphere}, Pair{Shape::cylinder, Shape::capsule},
                    Pair{Shape::cylinder, Shape::box}, Pair{Shape::cylinder, Shape::cylinder}),
    pair_name);

TEST(ContactMarginOfATiltedBox, has_all_four_corners_where_without_it_two_are_lost) {
  TwoGeoms geoms({Shape::box, Shape::plane});
  const double angle = 0.01;  // its far corners rise by 3 mm
  geoms.state().position[0] = {0, 0, 0.2 - 0.0005};
  geoms.state().orientation[0] = {std::cos(angle / 2), 0, std::sin(angle / 2), 0};
  EXPECT_EQ(geoms.touching().size(), 2u);
  EXPECT_EQ(geoms.contacts_ahead().size(), 4u);
}

TEST(ContactMarginOfCylinders, has_the_four_places_of_one_that_stands_just_over_another_or_a_box) {
  for (const Shape below : {Shape::cylinder, Shape::box}) {
    TwoGeoms geoms({Shape::cylinder, below});
    const double top = below == Shape::box ? 0.2 : 0.25;  // half its height
    geoms.state().position[0] = {0.01, 0.02, top + 0.25 + 0.002};
    geoms.state().position[1] = {0, 0, 0};
    EXPECT_TRUE(geoms.touching().empty());
    ASSERT_EQ(geoms.contacts_ahead().size(), 4u);
    for (const Contact& contact : geoms.contacts_ahead()) {
      EXPECT_NEAR(contact.depth, -0.002, 1e-9);
      EXPECT_NEAR(contact.position.z(), top + 0.001, 1e-9);
    }
  }
}

TEST(ContactMarginOfBoxes, has_the_four_corners_of_a_box_that_hangs_just_over_another) {
  TwoGeoms geoms({Shape::box, Shape::box});
  for (const double yaw : {0.0, 0.001, 0.3}) {
    geoms.state().position[0] = {0, 0, 0.4 + 0.002};
    geoms.state().position[1] = {0, 0, 0};
    geoms.state().orientation[0] = {std::cos(yaw / 2), 0, 0, std::sin(yaw / 2)};
    EXPECT_TRUE(geoms.touching().empty());
    ASSERT_EQ(geoms.contacts_ahead().size(), 4u) << "turned by " << yaw;
    for (const Contact& contact : geoms.contacts_ahead()) EXPECT_NEAR(contact.depth, -0.002, 1e-12);
  }
}

/// A box across another at a right angle, swaying slightly: the single point where two edges are closest
/// would not support it.
TEST(ContactMarginOfBoxes, has_the_four_corners_of_one_that_leans_across_another) {
  TwoGeoms geoms({Shape::box, Shape::box});
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> lean(-0.002, 0.002);
  const auto turned = [&](double yaw) {
    const model::Vec3 tilt(lean(engine), lean(engine), 0);
    const Eigen::Quaterniond turn =
        Eigen::AngleAxisd(tilt.norm(), tilt.normalized()) * Eigen::AngleAxisd(yaw, Vec3::UnitZ());
    return model::Quat{turn.w(), turn.x(), turn.y(), turn.z()};
  };
  int lost_three = 0;
  for (int i = 0; i < 500; ++i) {
    geoms.state().position[0] = {0.02, 0.03, 0.4 - 0.001};
    geoms.state().position[1] = {0, 0, 0};
    geoms.state().orientation[0] = turned(std::numbers::pi / 2);
    geoms.state().orientation[1] = turned(0);
    const std::vector<Contact> touching = geoms.touching(), ahead = geoms.contacts_ahead();
    lost_three += static_cast<int>(touching.size() == 1);
    ASSERT_EQ(ahead.size(), 4u) << "try " << i;
    EXPECT_LT(deepest(ahead).depth, 1.05 * deepest(touching).depth + 1e-9);
    EXPECT_GT(deepest(ahead).depth, deepest(touching).depth - 1e-9);
  }
  EXPECT_GT(lost_three, 50);
}

}  // namespace
}  // namespace pbmpi::solver
