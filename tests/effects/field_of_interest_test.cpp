#include "effects/field_of_interest.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random.h"
#include "support/models.h"

namespace pbmpi::effects {
namespace {

constexpr int num_bodies = 40;
using Indices = std::vector<int>;

/// Bodies in a cube of 10 m, a quarter of which are joined in pairs.
model::Model cloud(std::uint64_t seed) {
  model::Model model;
  for (int body = 0; body < num_bodies; ++body) {
    const auto number = [&](std::uint64_t k) {
      return 10 * core::to_unit(core::mix_key(seed, static_cast<std::uint64_t>(body), k));
    };
    const std::string name = "b" + std::to_string(body);
    support::add_solid(model, support::add_actor(model, name), name, model::Shape::sphere, {0.1, 0, 0}, 1,
                       {number(0), number(1), number(2)});
    if (body % 8 == 7) support::add_joint(model, model::JointKind::ball, body, body - 5, {0, 0, 0});
  }
  model.interest = model::Interest{{5, 5, 5}, model::no_body, 3, 4};
  return model;
}

std::vector<BodyPair> random_pairs(int count, std::uint64_t seed) {
  std::vector<BodyPair> pairs;
  for (int i = 0; i < count; ++i) {
    const auto pick = [&](std::uint64_t which, int least) {
      const auto choices = static_cast<std::uint64_t>(num_bodies - least);
      return static_cast<int>(core::mix_key(seed, static_cast<std::uint64_t>(i), which) % choices) + least;
    };
    pairs.emplace_back(pick(0, 0), pick(1, model::no_body));
  }
  return pairs;
}

std::vector<core::Vec3> positions(const model::Model& model) { return model::initial_state(model).position; }

Indices all_bodies() {
  Indices bodies;
  for (int body = 0; body < num_bodies; ++body) bodies.push_back(body);
  return bodies;
}

Indices to_vector(std::span<const int> bodies) { return {bodies.begin(), bodies.end()}; }

TEST(FieldOfInterest, has_the_islands_inside_of_which_any_body_is_near) {
  int cut = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const model::Model model = cloud(seed);
    const std::vector<BodyPair> touching = random_pairs(static_cast<int>(seed), seed);
    FieldOfInterest field(model, 20);
    field.sort(all_bodies(), positions(model), touching);

    std::vector<BodyPair> links = touching;
    for (const model::Joint& joint : model.joints) links.emplace_back(joint.body_a, joint.body_b);
    const model::Islands islands = model::find_islands(num_bodies, links);
    std::vector<bool> near(static_cast<std::size_t>(islands.count), false);
    for (int body = 0; body < num_bodies; ++body) {
      if ((model.bodies[body].pose.position - core::Vec3(5, 5, 5)).norm() <= 3)
        near[islands.of_body[body]] = true;
    }
    Indices inside, outside;
    for (int body = 0; body < num_bodies; ++body)
      (near[islands.of_body[body]] ? inside : outside).push_back(body);
    EXPECT_EQ(to_vector(field.inside()), inside);
    EXPECT_EQ(to_vector(field.outside()), outside);
    for (int body = 0; body < num_bodies; ++body) {
      EXPECT_EQ(field.contains(body), near[islands.of_body[body]]);
      EXPECT_EQ(field.iterations_of(body), near[islands.of_body[body]] ? 20 : 4);
    }
    cut += !inside.empty() && !outside.empty() ? 1 : 0;
  }
  EXPECT_GT(cut, 40) << "most clouds have both sorts";
}

TEST(FieldOfInterest, sorts_only_the_bodies_that_it_is_given) {
  const model::Model model = cloud(1);
  FieldOfInterest field(model, 20);
  field.sort(all_bodies(), positions(model), std::span<const model::Contact>());
  ASSERT_FALSE(field.inside().empty());
  field.sort(Indices{}, positions(model), std::span<const model::Contact>());
  EXPECT_TRUE(field.inside().empty());
  EXPECT_TRUE(field.outside().empty());
  for (int body = 0; body < num_bodies; ++body) EXPECT_FALSE(field.contains(body));
}

TEST(FieldOfInterest, joins_islands_by_contacts_as_by_pairs) {
  const model::Model model = cloud(2);
  FieldOfInterest by_pairs(model, 20), by_contacts(model, 20);
  const std::vector<BodyPair> touching = random_pairs(20, 2);
  std::vector<model::Contact> contacts;
  for (const auto& [a, b] : touching) {
    contacts.emplace_back();
    contacts.back().body_a = a;
    contacts.back().body_b = b;
  }
  by_pairs.sort(all_bodies(), positions(model), touching);
  by_contacts.sort(all_bodies(), positions(model), contacts);
  EXPECT_EQ(to_vector(by_pairs.inside()), to_vector(by_contacts.inside()));
}

TEST(FieldOfInterest, follows_the_body_that_it_is_told_of) {
  model::Model model = cloud(3);
  model.interest->follows = 7;
  model.interest->radius_m = 1e-3;
  FieldOfInterest field(model, 20);
  EXPECT_EQ(field.follows(), 7);
  field.look(positions(model));
  field.sort(all_bodies(), positions(model), std::span<const model::Contact>());
  EXPECT_EQ(to_vector(field.inside()), (Indices{2, 7})) << "a joint holds 2 to 7";
  field.set_center(positions(model)[20]);
  field.sort(all_bodies(), positions(model), std::span<const model::Contact>());
  EXPECT_EQ(to_vector(field.inside()), (Indices{20}));
}

TEST(FieldOfInterest, stays_where_it_is_if_it_follows_nothing) {
  const model::Model model = cloud(4);
  FieldOfInterest field(model, 20);
  field.look(positions(model));
  EXPECT_TRUE(field.is_near({5, 5, 8}));
  EXPECT_FALSE(field.is_near({5, 5, 8.001}));
}

TEST(FieldOfInterest, has_all_inside_where_no_model_asks_for_one) {
  model::Model model = cloud(5);
  model.interest.reset();
  FieldOfInterest field(model, 20);
  std::vector<core::Vec3> position = positions(model);
  position[3].x() = NAN;
  field.look(position);
  field.sort(all_bodies(), position, std::span<const model::Contact>());
  EXPECT_EQ(to_vector(field.inside()), all_bodies());
}

TEST(FieldOfInterest, gives_nobody_more_iterations_than_the_run_has) {
  const model::Model model = cloud(6);
  EXPECT_EQ(FieldOfInterest(model, 20).outside_iterations(), 4);
  EXPECT_EQ(FieldOfInterest(model, 3).outside_iterations(), 3);
  EXPECT_EQ(FieldOfInterest(model, 3).outside_share(), 1);
  EXPECT_LT(FieldOfInterest(model, 20).outside_share(), 1);
  EXPECT_GT(FieldOfInterest(model, 20).outside_share(), 4.0 / 20);
}

TEST(FieldOfInterest, is_not_joined_by_a_broken_joint) {
  model::Model model;
  for (const double x : {0.0, 5.0, 10.0}) {
    const std::string name = "b" + std::to_string(static_cast<int>(x));
    support::add_solid(model, support::add_actor(model, name), name, model::Shape::sphere, {0.1, 0, 0}, 1,
                       {x, 0, 0});
  }
  support::add_joint(model, model::JointKind::ball, 0, 1, {2.5, 0, 0});
  support::add_joint(model, model::JointKind::ball, 1, 2, {7.5, 0, 0});
  model.interest = model::Interest{{0, 0, 0}, model::no_body, 1, 4};
  FieldOfInterest field(model, 20);
  const auto inside = [&](std::span<const model::Contact> contacts) {
    field.sort(Indices{0, 1, 2}, positions(model), contacts);
    return to_vector(field.inside());
  };
  EXPECT_EQ(inside({}), (Indices{0, 1, 2}));
  field.set_broken(model, std::vector<std::int32_t>{model::unbroken, 7});
  EXPECT_EQ(inside({}), (Indices{0, 1}));
  field.set_broken(model, std::vector<std::int32_t>{3, 7});
  EXPECT_EQ(inside({}), (Indices{0}));
  model::Contact contact;
  contact.body_a = 0;
  contact.body_b = 2;
  EXPECT_EQ(inside(std::span(&contact, 1)), (Indices{0, 2})) << "what touches is one island all the same";
  field.set_broken(model, {});
  EXPECT_EQ(inside({}), (Indices{0, 1, 2})) << "another state, in which all holds";
}

}  // namespace
}  // namespace pbmpi::effects
