#include "analysis/joint_coordinates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/models.h"

namespace pbmpi::analysis {
namespace {

using namespace model;

constexpr double rounding = 1e-12;

/// A body that hangs on the world by a joint at the origin with axis 1 along y and axis 2 along z.
Model jointed(JointKind kind) {
  Model model;
  const int actor = support::add_actor(model, "one");
  support::add_solid(model, actor, "body", Shape::box, {1, 1, 1}, 1, {2, 0, 0},
                     support::rotation(Vec3::UnitX(), 0.3));
  Joint joint;
  joint.kind = kind;
  const auto back = model.bodies[0].pose.orientation.to_eigen().conjugate();
  joint.anchor_a = back * Vec3(-2, 0, 0);
  joint.axis1_a = back * Vec3::UnitY();
  joint.axis2_b = Vec3::UnitZ();
  model.joints.push_back(joint);
  return model;
}

std::vector<double> measured(const Model& model, const State& state) {
  const JointCoordinates coordinates(model);
  std::vector<double> values(coordinates.axes().size());
  coordinates.measure(state, values);
  return values;
}

State turned(const Model& model, const Quat& turn) {
  State state = initial_state(model);
  state.orientation[0] = Quat::from_eigen(turn.to_eigen() * state.orientation[0].to_eigen());
  return state;
}

TEST(JointCoordinates, are_0_at_the_start) {
  for (const JointKind kind : {JointKind::hinge, JointKind::slider, JointKind::universal}) {
    const Model model = jointed(kind);
    for (const double value : measured(model, initial_state(model))) EXPECT_NEAR(value, 0, rounding);
  }
}

TEST(JointCoordinates, of_a_hinge_are_the_angle_of_its_first_body) {
  const Model model = jointed(JointKind::hinge);
  for (const double angle : {-3.0, -0.5, 0.1, 2.9}) {
    EXPECT_NEAR(measured(model, turned(model, support::rotation(Vec3::UnitY(), angle)))[0], angle, rounding);
  }
}

TEST(JointCoordinates, of_a_hinge_count_the_turns_that_the_state_counts) {
  const Model model = jointed(JointKind::hinge);
  State state = turned(model, support::rotation(Vec3::UnitY(), 0.5));
  state.memory.joints.resize(1);
  state.memory.joints[0].angle[0] = -6;
  EXPECT_NEAR(measured(model, state)[0], 0.5 - 2 * std::acos(-1.0), rounding);
}

TEST(JointCoordinates, of_a_slider_are_the_way_along_its_axis) {
  const Model model = jointed(JointKind::slider);
  State state = initial_state(model);
  state.position[0] += Vec3(0, -0.7, 0);
  EXPECT_NEAR(measured(model, state)[0], -0.7, rounding);
}

TEST(JointCoordinates, of_a_universal_joint_are_the_angles_about_both_axes) {
  const Model model = jointed(JointKind::universal);
  const Quat outer = support::rotation(Vec3::UnitZ(), 0.4), inner = support::rotation(Vec3::UnitY(), -0.9);
  const State state = turned(model, Quat::from_eigen(outer.to_eigen() * inner.to_eigen()));
  const std::vector<double> values = measured(model, state);
  EXPECT_NEAR(values[0], -0.9, rounding);
  EXPECT_NEAR(values[1], 0.4, rounding);
}

}  // namespace
}  // namespace pbmpi::analysis
