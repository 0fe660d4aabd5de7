#include "scenes/links/joint_chain.h"

#include <gtest/gtest.h>

namespace pbmpi::scenes::links {
namespace {

using model::JointKind;
using model::Mat3;

LinkJoint hinge(const Vec3& axis, const Vec3& anchor = Vec3::Zero()) {
  LinkJoint joint;
  joint.axis = axis.normalized();
  joint.anchor = anchor;
  return joint;
}

Rigid rod(std::vector<LinkJoint> joints) {
  Rigid rigid;
  rigid.mass = {3, {0, 0, -0.5}, Vec3(0.25, 0.25, 0.01).asDiagonal()};  // 1 m long
  rigid.joints = std::move(joints);
  return rigid;
}

Mat3 about_origin(const MassProperties& mass) {
  return mass.inertia + mass.mass_kg * (mass.centre.squaredNorm() * Mat3::Identity() -
                                        mass.centre * mass.centre.transpose());
}

TEST(JointChain, of_one_joint_is_that_joint) {
  const JointChain chain = chain_of(rod({hinge(Vec3::UnitY())}));
  ASSERT_EQ(chain.pieces.size(), 1u);
  EXPECT_EQ(chain.pieces[0].kind, JointKind::hinge);
  EXPECT_TRUE(chain.between.empty());
  EXPECT_EQ(chain.rest.mass_kg, 3);
}

TEST(JointChain, of_two_hinges_at_right_angles_is_a_universal_joint) {
  const JointChain chain = chain_of(rod({hinge({1, 1, 0}), hinge({1, -1, 0})}));
  ASSERT_EQ(chain.pieces.size(), 1u);
  EXPECT_EQ(chain.pieces[0].kind, JointKind::universal);
  EXPECT_TRUE(chain.between.empty());
}

TEST(JointChain, needs_a_body_between_skew_or_distant_hinges) {
  EXPECT_EQ(chain_of(rod({hinge({1, 1, 0}), hinge({1, 0, 0})})).between.size(), 1u);
  EXPECT_EQ(chain_of(rod({hinge({1, 0, 0}), hinge({0, 1, 0}, {0, 0, 0.1})})).between.size(), 1u);
}

TEST(JointChain, of_three_hinges_about_a_point_keeps_mass_centre_and_inertia_about_it) {
  const Rigid rigid = rod({hinge({1, 0, 0}), hinge({0, 0, 1}), hinge({0, 1, 0})});
  const JointChain chain = chain_of(rigid);
  ASSERT_EQ(chain.pieces.size(), 2u);
  EXPECT_EQ(chain.pieces[0].kind, JointKind::hinge);
  EXPECT_EQ(chain.pieces[1].kind, JointKind::universal);
  EXPECT_TRUE(chain.is_gimbal);
  ASSERT_EQ(chain.between.size(), 1u);
  const MassProperties& between = chain.between[0];
  EXPECT_NEAR(between.mass_kg, share_between * 3, 1e-12);
  EXPECT_EQ(between.centre, Vec3(0, 0, 0));
  EXPECT_NEAR(between.mass_kg + chain.rest.mass_kg, 3, 1e-12);
  EXPECT_NEAR(chain.rest.mass_kg * chain.rest.centre.z(), -1.5, 1e-12);
  EXPECT_TRUE(about_origin(chain.rest).isApprox(about_origin(rigid.mass), 1e-12));
  EXPECT_LT(between.inertia.maxCoeff(), 0.021 * about_origin(rigid.mass).maxCoeff());
}

TEST(JointChain, takes_a_smaller_share_of_what_is_far_and_thin) {
  Rigid rigid = rod({hinge({1, 0, 0}), hinge({0, 0, 1}), hinge({0, 1, 0})});
  rigid.mass.centre.z() = -5;
  const JointChain chain = chain_of(rigid);
  EXPECT_LT(chain.between[0].mass_kg, 0.01);
  EXPECT_GT(chain.rest.inertia.eigenvalues().real().minCoeff(), 0.005) << "it stays a body";
}

TEST(JointChain, of_slides_keeps_mass_and_centre) {
  LinkJoint x = hinge({1, 0, 0}), z = hinge({0, 0, 1});
  x.motion = z.motion = Motion::slide;
  const JointChain chain = chain_of(rod({x, z, hinge({0, 1, 0})}));
  ASSERT_EQ(chain.pieces.size(), 3u);
  EXPECT_FALSE(chain.is_gimbal);
  double mass = chain.rest.mass_kg;
  for (const MassProperties& between : chain.between) {
    mass += between.mass_kg;
    EXPECT_EQ(between.centre, Vec3(0, 0, -0.5));
  }
  EXPECT_NEAR(mass, 3, 1e-12);
  EXPECT_EQ(chain.rest.centre, Vec3(0, 0, -0.5));
}

}  // namespace
}  // namespace pbmpi::scenes::links
