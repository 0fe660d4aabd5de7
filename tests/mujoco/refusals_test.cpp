#include <algorithm>

#include <gtest/gtest.h>

#include "core/error.h"
#include "mujoco/mujoco_stepper.h"
#include "simulation.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::Model;
using model::Shape;

std::string message_of(const Model& model) {
  const auto stepper = make_mujoco_stepper(settings_with());
  try {
    stepper->add(0, std::make_shared<Model>(model), model::initial_state(model), 0);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "not refused";
}

bool mentions(const std::vector<std::string>& sentences, const std::string& word) {
  return std::ranges::any_of(
      sentences, [&](const std::string& sentence) { return sentence.find(word) != std::string::npos; });
}

/// Balls in a square grid above the ground; they touch if they are closer than 1 m.
Model balls(int num_balls, double distance) {
  Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "balls", model::ActorKind::prop, true);
  for (int i = 0; i < num_balls; ++i)
    support::add_solid(model, actor, "ball" + std::to_string(i), Shape::sphere, {0.5, 0, 0}, 1,
                       {distance * (i % 50), distance * (i / 50), 1});
  return model;
}

TEST(MujocoRefusals, name_what_is_too_large_before_it_is_compiled) {
  const std::string message = message_of(balls(2500, 1.5));  // matrices of 15000 degrees of freedom
  EXPECT_NE(message.find("2500 bodies with 15000 degrees of freedom"), std::string::npos) << message;
  EXPECT_NE(message.find("addresses no more than 17.2 GB"), std::string::npos) << message;
}

TEST(MujocoRefusals, name_what_has_too_many_rows_before_there_is_memory_for_them) {
  const std::string message = message_of(balls(120, 0.01));  // all touch each other: 3 rows of 7140 contacts
  EXPECT_NE(message.find("120 bodies with 720 degrees of freedom and room for 21420 "), std::string::npos)
      << message;
  EXPECT_NE(message.find("addresses no more than 2.1 GB"), std::string::npos) << message;
}

TEST(MujocoRefusals, name_an_effect_that_is_not_there) {
  Model model = support::free_box();
  model.effects["sleeping"] = true;
  EXPECT_NE(message_of(model).find("'sleeping'"), std::string::npos);
}

TEST(MujocoRefusals, name_what_the_kind_of_a_joint_lacks) {
  Model model = support::chain(1);
  model.joints[0].limits[0] = {-1, 1};
  EXPECT_NE(message_of(model).find("cannot limit"), std::string::npos);
}

TEST(MujocoRefusals, are_none_for_what_it_can_step) {
  EXPECT_TRUE(refusals(support::crash()).empty());
  EXPECT_TRUE(inexpressible(support::pendulum(1, 0.1)).empty());
}

TEST(MujocoInexpressible, is_what_does_not_bounce_and_what_has_no_bound) {
  Model model = support::box_over_ground(1);
  model.geoms[1].material.restitution = 0.5;
  EXPECT_TRUE(mentions(inexpressible(model), "bounce"));
  model.geoms[1].material.mu = model::infinity;
  EXPECT_TRUE(mentions(inexpressible(model), "without bound"));
  EXPECT_TRUE(refusals(model).empty()) << "it steps them all the same";
}

TEST(MujocoInexpressible, names_the_version_of_the_library) {
  EXPECT_EQ(mujoco_version().substr(0, 2), "2.");
}

}  // namespace
}  // namespace pbmpi::mujoco
