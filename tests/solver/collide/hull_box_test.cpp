/// A hull with the corners of a box touches others where the kernels of boxes find that the box does.
#include <gtest/gtest.h>

#include <algorithm>

#include "geometry/geometry.h"
#include "geometry/hulls/convex_hull.h"
#include "geometry/hulls/hull_contacts.h"
#include "solver/collide/geom_pairs.h"

namespace pbmpi::solver {
namespace {

using model::Contact;
using model::Shape;
using model::Vec3;

model::Geom as_hull(const model::Geom& box) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 signs((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    corners.emplace_back(0.5 * Vec3(box.size.data()).cwiseProduct(signs));
  }
  model::Geom hull = box;
  hull.shape = Shape::hull;
  hull.hull = geometry::convex_hull(corners, 8, "box").hull;
  return hull;
}

/// Contacts in the order of their places.
std::vector<Contact> sorted(std::vector<Contact> contacts) {
  constexpr double cell = 1e-6;  // [m] places that differ by rounding only must not change the order
  std::ranges::sort(contacts, {}, [](const Contact& contact) {
    return std::array{std::round(contact.position.x() / cell), std::round(contact.position.y() / cell)};
  });
  return contacts;
}

void expect_equal(const model::Geom& box, const model::Pose& pose, const model::Geom& other, int i) {
  const std::vector<Contact> wanted = sorted(contacts_of(box, pose, other));
  const bool other_is_box = other.shape == Shape::box;
  const auto found = geometry::HullContacts(0).collide(as_hull(box), geometry::body_pose(pose),
                                                       other_is_box ? as_hull(other) : other,
                                                       geometry::geom_pose(other, geometry::static_pose()));
  std::vector<Contact> own(static_cast<std::size_t>(found.count));
  for (std::size_t k = 0; k < own.size(); ++k) {
    own[k].position = found.points[k].position;
    own[k].normal = found.normal;
    own[k].depth = found.points[k].depth;
  }
  own = sorted(own);
  ASSERT_EQ(own.size(), wanted.size()) << i;
  constexpr double rounding = 1e-12;
  for (std::size_t k = 0; k < own.size(); ++k) {
    EXPECT_LT((own[k].position - wanted[k].position).norm(), rounding) << i;
    EXPECT_LT((own[k].normal - wanted[k].normal).norm(), rounding) << i;
    EXPECT_NEAR(own[k].depth, wanted[k].depth, rounding) << i;
  }
}

/// Sunk by 0.1 mm into what is below it, and turned about the vertical.
model::Pose resting(const model::Geom& box, double top, Dice& dice) {
  const double half_angle = dice.between(-1.5, 1.5);
  const double x = dice.between(-0.2, 0.2), y = dice.between(-0.2, 0.2);
  return {{x, y, top + 0.5 * box.size[2] - 1e-4}, {std::cos(half_angle), 0, 0, std::sin(half_angle)}};
}

// On a table that is larger: where faces meet in more than four points, rounding decides which of these are
// kept.
TEST(HullOfABox, rests_on_a_box_on_the_points_of_a_box) {
  Dice dice(5);
  for (int i = 0; i < 300; ++i) {
    const model::Geom box = make_geom(Shape::box, 0, dice);
    const model::Geom table = geom_of(Shape::box, model::no_body, {3, 3, 0.4});
    expect_equal(box, resting(box, 0.2, dice), table, i);
  }
}

TEST(HullOfABox, rests_on_a_plane_on_the_points_of_a_box) {
  Dice dice(6);
  for (int i = 0; i < 300; ++i) {
    const model::Geom box = make_geom(Shape::box, 0, dice);
    expect_equal(box, resting(box, 0, dice), geom_of(Shape::plane, model::no_body, {}), i);
  }
}

}  // namespace
}  // namespace pbmpi::solver
