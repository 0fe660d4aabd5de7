#include "scenes/links/massless.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace pbmpi::scenes::links {
namespace {

Link link(const std::string& name, int parent, double mass_kg, const Vec3& position, const Vec3& axis) {
  Link link;
  link.name = name;
  link.where = name;
  link.parent = parent;
  link.pose = {position, rotation(0.5, Vec3::UnitZ())};
  if (mass_kg > 0) link.mass = MassProperties{mass_kg, Vec3::Zero(), model::Mat3::Identity()};
  LinkJoint joint;
  joint.name = name + ".joint";
  joint.axis = axis;
  link.joints.push_back(joint);
  return link;
}

RigidTree merged(std::vector<Link> links, xml::Notes& notes) {
  Mechanism mechanism;
  mechanism.links = std::move(links);
  mechanism.joins_massless = true;
  return merge(mechanism, notes);
}

TEST(Massless, at_the_end_is_part_of_what_bears_it) {
  xml::Notes notes;
  const RigidTree tree =
      merged({link("arm", no_link, 2, {0, 0, 1}, Vec3::UnitX()), link("tool", 0, 0, {1, 0, 0}, Vec3::UnitY()),
              link("tip", 1, 0, {1, 0, 0}, Vec3::UnitY()), link("hand", 0, 1, {0, 1, 0}, Vec3::UnitZ())},
             notes);
  ASSERT_EQ(tree.rigids.size(), 3u);
  EXPECT_EQ(tree.rigid_of, (std::vector<int>{1, 1, 1, 2}));
  EXPECT_EQ(tree.rigids[2].name, "hand");
  EXPECT_EQ(tree.rigids[2].parent, 1);
  EXPECT_EQ(notes.lines().size(), 2u);
}

// Turning the joints of the chain one after the other takes the last link where its own joints then take it.
TEST(Massless, in_a_chain_passes_its_joints_on) {
  xml::Notes notes;
  const std::vector<Link> links = {link("x", no_link, 0, {1, 2, 3}, Vec3::UnitX()),
                                   link("y", 0, 0, {0.3, 0.2, 0.1}, Vec3::UnitY()),
                                   link("body", 1, 5, {0, 0.4, 0.6}, Vec3(0.6, 0, 0.8))};
  const RigidTree tree = merged(links, notes);
  ASSERT_EQ(tree.rigids.size(), 2u);
  const Rigid& body = tree.rigids[1];
  ASSERT_EQ(body.joints.size(), 3u);
  EXPECT_EQ(body.parent, 0);
  const double angles[] = {0.3, -0.8, 1.1};
  const auto turned = [](const LinkJoint& joint, double angle) {
    const Quat turn = rotation(angle, joint.axis);
    return Pose{joint.anchor - turn.to_eigen() * joint.anchor, turn};
  };
  Pose expected, found = body.pose;
  for (int i = 0; i < 3; ++i) {
    expected = compose(compose(expected, links[static_cast<std::size_t>(i)].pose),
                       turned(links[static_cast<std::size_t>(i)].joints[0], angles[i]));
    found = compose(found, turned(body.joints[static_cast<std::size_t>(i)], angles[i]));
  }
  EXPECT_LT((found.position - expected.position).norm(), 1e-12);
  EXPECT_LT(found.orientation.to_eigen().angularDistance(expected.orientation.to_eigen()), 1e-7);
}

TEST(Massless, that_touches_or_branches_is_refused_with_all_names) {
  const auto refusal = [](std::vector<Link> links) -> std::string {
    xml::Notes notes;
    try {
      merged(std::move(links), notes);
      return "";
    } catch (const core::InputError& error) {
      return error.what();
    }
  };
  std::vector<Link> wheels = {link("base", no_link, 2, {0, 0, 1}, Vec3::UnitX()),
                              link("left", 0, 0, {0, 1, 0}, Vec3::UnitY()),
                              link("right", 0, 0, {0, -1, 0}, Vec3::UnitY())};
  wheels[1].geoms.emplace_back();
  wheels[2].geoms.emplace_back();
  EXPECT_NE(refusal(wheels).find("'left', 'right' move but have no mass"), std::string::npos)
      << refusal(wheels);
  const std::vector<Link> fork = {link("fork", no_link, 0, {0, 0, 1}, Vec3::UnitX()),
                                  link("left", 0, 1, {0, 1, 0}, Vec3::UnitY()),
                                  link("right", 0, 1, {0, -1, 0}, Vec3::UnitY())};
  EXPECT_NE(refusal(fork).find("'fork' moves but has no mass"), std::string::npos) << refusal(fork);
}

// A search of all links for each of them would not end.
TEST(Massless, of_any_number_are_joined) {
  constexpr int count = 200'000;
  std::vector<Link> links = {link("hub", no_link, 2, {0, 0, 1}, Vec3::UnitX())};
  for (int i = 1; i <= count; ++i)
    links.push_back(link("tip" + std::to_string(i), 0, 0, {1, 0, 0}, Vec3::UnitY()));
  xml::Notes notes;
  const RigidTree tree = merged(std::move(links), notes);
  EXPECT_EQ(tree.rigids.size(), 2u);
  EXPECT_EQ(tree.rigid_of, std::vector<int>(count + 1, 1));
}

}  // namespace
}  // namespace pbmpi::scenes::links
