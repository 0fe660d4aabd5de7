#include "scenes/links/rigid.h"

#include <gtest/gtest.h>

namespace pbmpi::scenes::links {
namespace {

Link link(const std::string& name, int parent, double mass_kg, const Vec3& position) {
  Link link;
  link.name = name;
  link.parent = parent;
  link.pose.position = position;
  link.mass = MassProperties{mass_kg, Vec3::Zero(), model::Mat3::Identity()};
  return link;
}

TEST(RigidTree, joins_links_without_joints_to_those_above) {
  Mechanism mechanism;
  mechanism.links = {link("base", no_link, 1, {0, 0, 1}), link("arm", 0, 2, {1, 0, 0}),
                     link("tool", 1, 6, {0, 4, 0}), link("hand", 2, 1, {0, 1, 0})};
  mechanism.links[1].joints.emplace_back();
  mechanism.links[3].joints.emplace_back();
  xml::Notes notes;
  const RigidTree tree = merge(mechanism, notes);
  ASSERT_EQ(tree.rigids.size(), 3u);
  EXPECT_EQ(tree.rigid_of, (std::vector<int>{0, 1, 1, 2}));
  EXPECT_EQ(tree.rigids[1].name, "arm");
  EXPECT_EQ(tree.rigids[1].mass.mass_kg, 8);
  EXPECT_EQ(tree.rigids[1].mass.centre, Vec3(0, 3, 0));
  EXPECT_NEAR(tree.rigids[1].mass.inertia(0, 0), 2 + 2 * 9 + 6 * 1, 1e-12);
  EXPECT_EQ(tree.rigids[2].parent, 1);
  EXPECT_EQ(tree.rigids[2].pose.position, Vec3(1, 5, 1));
}

}  // namespace
}  // namespace pbmpi::scenes::links
