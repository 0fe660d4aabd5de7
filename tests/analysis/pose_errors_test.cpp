#include "analysis/pose_errors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/error_bands.h"
#include "model/state.h"
#include "support/models.h"

namespace pbmpi::analysis {
namespace {

using model::JointKind;
using model::Quat;
using model::State;
using model::Vec3;

constexpr double degree = std::numbers::pi / 180;
// Numbers of size 1 go through a dozen roundings of 1e-16.
constexpr double rounding = 1e-14;

PoseView view(const State& state) { return {state.position, state.orientation}; }

Quat times(const Quat& a, const Quat& b) { return Quat::from_eigen(a.to_eigen() * b.to_eigen()); }

TEST(PoseErrors, a_state_has_no_error_against_itself_and_an_entry_for_every_body_and_joint) {
  const model::Model model = support::crash();
  const State state = model::initial_state(model);
  const PoseErrors errors = compare(model, view(state), view(state));
  EXPECT_EQ(errors.body_position_m, std::vector<double>(37, 0.0));
  EXPECT_EQ(errors.body_orientation_rad.size(), 37u);
  EXPECT_EQ(errors.joint_position_m, std::vector<double>(34, 0.0));
  EXPECT_EQ(errors.joint_orientation_rad, std::vector<double>(34, 0.0));
  for (const double angle : errors.body_orientation_rad) EXPECT_NEAR(angle, 0, rounding);
}

TEST(PoseErrors, a_joint_that_is_broken_in_either_result_is_a_class_of_its_own) {
  const model::Model model = support::chain(3);
  const State reference = model::initial_state(model);
  State moved = reference;
  moved.position[2].z() += 1;
  EXPECT_EQ(compare(model, view(moved), view(reference)).joint_position_m.size(), 3u);
  moved.broken_in = {model::unbroken, model::unbroken, 5};
  const PoseView broken{moved.position, moved.orientation, moved.broken_in};
  for (const PoseErrors& errors :
       {compare(model, broken, view(reference)), compare(model, view(reference), broken)}) {
    EXPECT_EQ(errors.body_position_m.size(), 3u);
    EXPECT_EQ(errors.joint_orientation_rad.size(), 2u);
    ASSERT_EQ(errors.joint_position_m.size(), 2u);
    for (const double gap : errors.joint_position_m) EXPECT_NEAR(gap, 0, rounding);
    EXPECT_EQ(errors.joints, (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(errors.broken_joints, 1);
    const ErrorTable table = summarize(errors);
    EXPECT_EQ(table.joint_position.count, 3) << "as many entries as without the break";
    EXPECT_EQ(table.joint_position.broken, 1);
    EXPECT_EQ(table.joint_position.bands, (BandCounts{2, 0, 0, 0, 0}));
    EXPECT_EQ(table.body_position.broken, 0);
  }
}

TEST(PoseErrors, a_body_displaced_by_5_cm_is_5_cm_off) {
  const model::Model model = support::free_box();
  const State reference = model::initial_state(model);
  State moved = reference;
  moved.position[0] += 0.05 * Vec3(2, -3, 6) / 7;
  const PoseErrors errors = compare(model, view(moved), view(reference));
  EXPECT_NEAR(errors.body_position_m[0], 0.05, rounding);
  EXPECT_EQ(summarize_positions(errors.body_position_m).bands, (BandCounts{0, 1, 0, 0, 0}));
}

TEST(PoseErrors, a_rotation_of_30_degrees_about_a_skew_axis_is_30_degrees) {
  const Quat start = support::rotation(Vec3(0.6, 0, 0.8), 2.2);
  const Quat turned = times(support::rotation(Vec3(1, 2, -2) / 3, 30 * degree), start);
  EXPECT_NEAR(rotation_angle(turned, start), 30 * degree, rounding);
  EXPECT_EQ(orientation_band(rotation_angle(turned, start)), 1);
}

TEST(PoseErrors, tiny_rotations_keep_their_digits) {
  const Quat turned = support::rotation(Vec3::UnitY(), 1e-9);
  EXPECT_NEAR(rotation_angle(turned, Quat{}), 1e-9, 1e-22);  // an arc cosine would give 0 here
}

TEST(PoseErrors, q_and_minus_q_are_the_same_orientation) {
  const Quat q = support::rotation(Vec3(1, 2, -2) / 3, 1.1);
  EXPECT_NEAR(rotation_angle(q, {-q.w, -q.x, -q.y, -q.z}), 0, rounding);
}

TEST(PoseErrors, a_nan_body_is_in_the_last_category_and_so_are_its_joints) {
  const model::Model model = support::chain(3);
  const State reference = model::initial_state(model);
  State broken = reference;
  broken.orientation[1].x = std::numeric_limits<double>::quiet_NaN();
  const PoseErrors errors = compare(model, view(broken), view(reference));
  EXPECT_EQ(summarize_orientations(errors.body_orientation_rad).bands, (BandCounts{2, 0, 0, 0, 1}));
  EXPECT_EQ(summarize_positions(errors.body_position_m).bands, (BandCounts{3, 0, 0, 0, 0}));
  EXPECT_EQ(summarize_positions(errors.joint_position_m).bands, (BandCounts{1, 0, 0, 0, 2}));
  EXPECT_EQ(summarize_orientations(errors.joint_orientation_rad).bands, (BandCounts{1, 0, 0, 0, 2}));
}

TEST(PoseErrors, a_joint_pulled_2_cm_apart_is_2_cm_off_wherever_it_is_carried) {
  model::Model model;
  support::add_actor(model, "pair");
  for (const double x : {0.0, 1.0}) {
    support::add_solid(model, 0, x > 0 ? "b" : "a", model::Shape::box, {1, 1, 1}, 1, Vec3(x, 0, 0));
  }
  support::add_joint(model, JointKind::ball, 0, 1, Vec3(0.5, 0, 0));
  const State reference = model::initial_state(model);
  State pulled = reference;
  pulled.position[1] += Vec3(0, 0.02, 0);
  EXPECT_NEAR(compare(model, view(pulled), view(reference)).joint_position_m[0], 0.02, rounding);
  // The pair is rotated and translated as a whole: the bodies are far off, the joint no more than before.
  const Quat turn = support::rotation(Vec3(1, 2, -2) / 3, 1.0);
  for (int i = 0; i < 2; ++i) {
    pulled.position[i] = turn.to_eigen() * pulled.position[i] + Vec3(3, 2, 1);
    pulled.orientation[i] = times(turn, pulled.orientation[i]);
  }
  const PoseErrors errors = compare(model, view(pulled), view(reference));
  EXPECT_GT(errors.body_position_m[0], 1);
  EXPECT_NEAR(errors.joint_position_m[0], 0.02, rounding);
}

TEST(PoseErrors, a_hinge_bent_across_its_axis_shows_the_angle_and_turning_about_it_does_not) {
  model::Model model;
  support::add_actor(model, "door");
  for (const double x : {0.0, 1.0}) {
    support::add_solid(model, 0, x > 0 ? "b" : "a", model::Shape::box, {1, 1, 1}, 1, Vec3(x, 0, 0),
                       support::rotation(Vec3(0.6, 0, 0.8), 0.4));
  }
  for (const JointKind kind : {JointKind::hinge, JointKind::ball, JointKind::universal, JointKind::fixed}) {
    support::add_joint(model, kind, 0, 1, Vec3(0.5, 0, 0), Vec3::UnitZ(), Vec3::UnitX());
  }
  State state = model::initial_state(model);
  const Quat start = state.orientation[1];
  state.orientation[1] = times(support::rotation(Vec3::UnitZ(), 0.7), start);
  EXPECT_NEAR(joint_axis_angle(model, model.joints[0], view(state)), 0, rounding);
  EXPECT_NEAR(joint_axis_angle(model, model.joints[2], view(state)), 0, rounding);
  EXPECT_NEAR(joint_axis_angle(model, model.joints[3], view(state)), 0.7, rounding);
  state.orientation[1] = times(support::rotation(Vec3::UnitY(), 0.3), start);
  EXPECT_NEAR(joint_axis_angle(model, model.joints[0], view(state)), 0.3, rounding);
  EXPECT_EQ(joint_axis_angle(model, model.joints[1], view(state)), 0);
  EXPECT_NEAR(joint_axis_angle(model, model.joints[2], view(state)), 0.3, rounding);
}

}  // namespace
}  // namespace pbmpi::analysis
