#include <gtest/gtest.h>

#include "core/error.h"
#include "mujoco/mujoco_stepper.h"
#include "mujoco/tree/joint_tree.h"
#include "simulation.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::JointKind;
using model::Model;
using model::Vec3;

/// A chain between two walls, with its last link held like its first.
Model bridge(JointKind last) {
  Model model = support::chain(4);
  support::add_joint(model, last, 3, model::no_body, {2, 0, 5}, Vec3::UnitY());
  return model;
}

TEST(MujocoTree, hangs_every_body_on_its_parent_and_leaves_what_closes_a_loop) {
  const JointTree tree = make_joint_tree(bridge(JointKind::hinge), {});
  ASSERT_EQ(tree.closing.size(), 1u);
  EXPECT_EQ(tree.order.size(), 4u);
  EXPECT_EQ(bridge(JointKind::hinge).joints[tree.closing[0]].kind, JointKind::ball)
      << "the easiest to close with";
}

TEST(MujocoTree, leaves_out_what_is_broken) {
  std::vector<std::int32_t> broken(5, model::unbroken);
  broken[2] = 7;
  const JointTree tree = make_joint_tree(bridge(JointKind::ball), broken);
  EXPECT_TRUE(tree.closing.empty());
  EXPECT_EQ(tree.holds[3].joint, 4);
  EXPECT_EQ(tree.holds[3].parent, model::no_body);
}

class Bridge : public testing::TestWithParam<JointKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, Bridge, testing::Values(JointKind::ball, JointKind::hinge, JointKind::fixed));

TEST_P(Bridge, holds_with_a_small_gap) {
  Simulation simulation(bridge(GetParam()));
  simulation.advance(200);
  // Constraints that close loops are soft: one that carries 4 kg yields by some micrometres.
  EXPECT_LT(simulation.observables().joint_gap_m, 1e-3);
  EXPECT_EQ(simulation.observables().nonfinite, 0);
}

TEST(MujocoTree, closes_a_loop_of_hinges_whose_axes_stay_parallel) {
  Model model;
  const int actor = support::add_actor(model, "loop");
  for (int i = 0; i < 2; ++i)
    support::add_solid(model, actor, "bar" + std::to_string(i), model::Shape::box, {0.1, 0.1, 1}, 1,
                       {static_cast<double>(i), 0, -0.5});
  support::add_solid(model, actor, "base", model::Shape::box, {1, 0.1, 0.1}, 1, {0.5, 0, -1});
  for (int i = 0; i < 2; ++i) {
    const double x = i;
    support::add_joint(model, JointKind::hinge, i, model::no_body, {x, 0, 0}, Vec3::UnitY());
    support::add_joint(model, JointKind::hinge, i, 2, {x, 0, -1}, Vec3::UnitY());
  }
  model.bodies[0].velocity = model.bodies[1].velocity = {0.5, 0, 0};
  model.bodies[0].angular_velocity = model.bodies[1].angular_velocity = {0, -1, 0};
  model.bodies[2].velocity = {1, 0, 0};
  Simulation simulation(model);
  simulation.advance(100);
  EXPECT_LT(simulation.observables().joint_gap_m, 1e-3);
  const Vec3 up = simulation.state().orientation[2].to_eigen() * Vec3::UnitZ();
  EXPECT_GT(up.z(), 0.9999) << "the base of a parallelogram stays level";
}

TEST(MujocoTree, refuses_a_loop_that_only_sliders_could_close) {
  Model model = bridge(JointKind::ball);
  for (model::Joint& joint : model.joints) joint.kind = JointKind::slider;
  try {
    Simulation simulation(model);
    FAIL() << "it took a loop of sliders";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("closes a loop"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace pbmpi::mujoco
