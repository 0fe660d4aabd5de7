#include "solver/contacts/contact_recall.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pbmpi::solver {
namespace {

using model::Contact;
using model::ContactForce;
using model::GeomPair;
using model::no_body;
using model::Vec3;

/// Bodies lie at (10 body, 0, 0), and geom i + 1 is that of body i; geom 0 is the ground's.
Vec3 centre(int body) { return {10.0 * body, 0, 0}; }

Contact contact(const GeomPair& geoms, const Vec3& arm) {
  Contact found;
  found.geoms = geoms;
  found.body_a = geoms.first == 0 ? geoms.second - 1 : geoms.first - 1;
  found.body_b = geoms.first == 0 ? no_body : geoms.second - 1;
  found.position = centre(found.body_a) + arm;
  return found;
}

ContactForce force(const GeomPair& geoms, const Vec3& arm, double normal) {
  const Contact at = contact(geoms, arm);
  return {geoms, at.body_a, at.body_b, arm, normal, {0, 2 * normal, 0}};
}

constexpr auto keeps_none = [](const ContactForce&) { return false; };

/// The normal forces from which contacts start.
std::vector<double> recalled(const std::vector<Contact>& contacts, const std::vector<ContactForce>& before) {
  ContactRecall recall;
  recall.recall(contacts, before, centre, keeps_none);
  std::vector<double> normals;
  for (const ContactForce& found : recall.forces()) {
    normals.push_back(found.normal);
    EXPECT_EQ(found.friction, Vec3(0, 2 * found.normal, 0)) << "of the same point";
  }
  return normals;
}

TEST(ContactRecall, finds_the_nearest_point_of_the_same_pair) {
  const std::vector<ContactForce> before = {force({0, 1}, {1, 0, 0}, 1), force({0, 1}, {-1, 0, 0}, 2),
                                            force({0, 2}, {0.9, 0, 0}, 3)};
  EXPECT_EQ(recalled({contact({0, 1}, {-0.8, 0.1, 0}), contact({0, 1}, {0.9, 0, 0})}, before),
            (std::vector<double>{2, 1}))
      << "whatever the order";
  EXPECT_EQ(recalled({contact({0, 2}, {5, 5, 5})}, before), (std::vector<double>{3})) << "however far";
  EXPECT_EQ(recalled({contact({0, 3}, {1, 0, 0}), contact({1, 2}, {1, 0, 0})}, before),
            (std::vector<double>{0, 0}))
      << "other pairs were not in contact";
}

TEST(ContactRecall, sees_points_from_the_centre_of_their_first_body) {
  std::vector<Contact> moved = {contact({0, 1}, {1, 0, 0}), contact({0, 1}, {-1, 0, 0})};
  for (Contact& one : moved) one.position += Vec3(2, 0, 0);
  ContactRecall recall;
  const std::vector<ContactForce> before = {force({0, 1}, {1, 0, 0}, 1), force({0, 1}, {-1, 0, 0}, 2)};
  recall.recall(
      moved, before, [](int body) -> Vec3 { return centre(body) + Vec3(2, 0, 0); }, keeps_none);
  EXPECT_EQ(recall.forces()[0].normal, 1) << "the body has moved with its points";
  EXPECT_EQ(recall.forces()[1].normal, 2);
}

TEST(ContactRecall, gives_no_point_to_two) {
  const std::vector<ContactForce> one = {force({0, 1}, {0, 0, 0}, 5)};
  EXPECT_EQ(recalled({contact({0, 1}, {0.1, 0, 0}), contact({0, 1}, {0, 0, 0})}, one),
            (std::vector<double>{5, 0}))
      << "the first takes it, though the second is nearer";
  const std::vector<ContactForce> two = {force({0, 1}, {0, 0, 0}, 5), force({0, 1}, {1, 0, 0}, 6)};
  EXPECT_EQ(
      recalled({contact({0, 1}, {0, 0, 0}), contact({0, 1}, {0, 0, 0}), contact({0, 1}, {0, 0, 0})}, two),
      (std::vector<double>{5, 6, 0}));
}

TEST(ContactRecall, starts_from_nothing_without_a_step_before) {
  EXPECT_EQ(recalled({contact({0, 1}, {0, 0, 0})}, {}), (std::vector<double>{0}));
  EXPECT_EQ(recalled({}, {force({0, 1}, {0, 0, 0}, 5)}), (std::vector<double>{}));
}

TEST(ContactRecall, stores_what_the_step_ended_with_in_canonical_order) {
  const std::vector<ContactForce> before = {force({0, 2}, {0, 0, 0}, 7), force({1, 2}, {0, 0, 0}, 8)};
  ContactRecall recall;
  recall.recall(
      std::vector{contact({0, 1}, {1, 0, 0}), contact({0, 1}, {2, 0, 0}), contact({1, 3}, {3, 0, 0})}, before,
      centre, keeps_none);
  for (ContactForce& found : recall.forces()) found.normal = 10 + found.arm.x();
  std::vector<ContactForce> memory = before;
  recall.store(memory);
  ASSERT_EQ(memory.size(), 3u) << "what touches no more is forgotten";
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(memory[i].arm, Vec3(1.0 + static_cast<double>(i), 0, 0));
    EXPECT_EQ(memory[i].normal, 11.0 + static_cast<double>(i));
  }
  EXPECT_EQ(memory[2].body_a, 0);
  EXPECT_EQ(memory[2].body_b, 2);
}

TEST(ContactRecall, keeps_the_rows_of_bodies_that_are_not_looked_at) {
  const std::vector<ContactForce> before = {force({0, 1}, {0, 0, 0}, 1), force({0, 2}, {0, 0, 0}, 2),
                                            force({0, 2}, {1, 0, 0}, 3), force({0, 4}, {0, 0, 0}, 4)};
  const auto is_asleep = [](const ContactForce& old) { return old.body_a == 1; };
  ContactRecall recall;
  std::vector<ContactForce> memory = before;
  for (int step = 0; step < 3; ++step) {  // the same for any number of steps asleep
    recall.recall(std::vector{contact({0, 1}, {0, 0, 0}), contact({0, 3}, {0, 0, 0})},
                  std::vector<ContactForce>(memory), centre, is_asleep);
    EXPECT_EQ(recall.forces().size(), 2u) << "the kept ones are solved by nobody";
    recall.store(memory);
    ASSERT_EQ(memory.size(), 4u);
    EXPECT_TRUE(std::ranges::is_sorted(memory, {}, &ContactForce::geoms));
    const double normals[] = {1, 2, 3, 0};
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(memory[i].normal, normals[i]);
  }
}

}  // namespace
}  // namespace pbmpi::solver
