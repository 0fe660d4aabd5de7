/// Contacts of bodies whose joints have armatures: they meet what the articulation makes of the body.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/mechanics.h"
#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::JointKind;
using model::Model;
using model::Vec3;

/// A bar of 50 g and a metre on a hinge half a metre above the ground, level at the start. `armature` and
/// `inertia` [kg m^2]: about the hinge, and added to the bar's own.
Model falling_bar(double armature, double inertia) {
  Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "bar");
  const int bar =
      support::add_solid(model, actor, "bar", model::Shape::box, {1, 0.05, 0.05}, 0.05, {0.5, 0, 0.5});
  const int hinge =
      support::add_joint(model, JointKind::hinge, bar, model::no_body, {0, 0, 0.5}, Vec3::UnitY());
  model.joints[static_cast<std::size_t>(hinge)].armature[0] = armature;
  model.bodies[bar].inertia += inertia * model::Mat3::Identity();
  return model;
}

/// A ball of 1 kg on two legs of 50 g with armatures, with its feet 5 cm above the ground.
Model two_legs(double armature) {
  Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "robot");
  const int torso =
      support::add_solid(model, actor, "torso", model::Shape::sphere, {0.1, 0, 0}, 1, {0, 0, 0.5});
  for (const double side : {-1.0, 1.0}) {
    const Vec3 hip(side * 0.12, 0, 0.5);
    const int leg = support::add_solid(model, actor, side < 0 ? "left" : "right", model::Shape::box,
                                       {0.4, 0.04, 0.04}, 0.05, hip + Vec3(side * 0.15, 0, -0.15),
                                       support::rotation(Vec3::UnitY(), side * 0.25 * std::acos(-1.0)));
    const int joint = support::add_joint(model, JointKind::hinge, leg, torso, hip, Vec3::UnitY());
    model.joints[static_cast<std::size_t>(joint)].name = side < 0 ? "left" : "right";
    model.joints[static_cast<std::size_t>(joint)].armature[0] = armature;
  }
  return model;
}

stepping::StepperSettings settings_with(double dt_s, stepping::Precision precision) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.dt_s = dt_s;
  settings.precision = precision;
  return settings;
}

// About a fixed axis an armature is an inertia of the bar: it falls as a bar of as much inertia, and once its
// end has met the ground it lies there.
TEST(RotorContacts, stop_a_bar_on_a_hinge_for_good) {
  for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
    for (const double dt_s : {0.002, 0.01}) {
      const auto geared = make_stepper(settings_with(dt_s, precision), {falling_bar(0.5, 0)}),
                 heavy = make_stepper(settings_with(dt_s, precision), {falling_bar(0, 0.5)});
      double at_s = 0;
      for (; heavy->state(0).memory.contacts.empty() && at_s < 3; at_s += dt_s) {
        ASSERT_NEAR(geared->state(0).position[0].z(), heavy->state(0).position[0].z(), 1e-3) << at_s << " s";
        advance(*geared, 1);
        advance(*heavy, 1);
      }
      advance(*geared, static_cast<int>(0.1 / dt_s));
      const double landed_m = geared->state(0).position[0].z();
      EXPECT_LT(landed_m, 0.27) << "the end is on the ground";
      for (double rest_s = 0; rest_s < 1.5; rest_s += dt_s) {
        advance(*geared, 1);
        ASSERT_LT(geared->state(0).position[0].z(), landed_m + 5e-3) << dt_s;
      }
      EXPECT_LT(geared->state(0).velocity[0].norm(), 2e-3) << dt_s;
    }
  }
}

TEST(RotorContacts, give_no_robot_energy_that_lands) {
  for (const double armature : {0.01, 0.1, 1.0}) {
    const Model model = two_legs(armature);
    for (const double dt_s : {0.001, 0.002, 0.005, 0.01, 0.02}) {
      const auto stepper = make_stepper(settings_with(dt_s, stepping::Precision::double_), {model});
      const double start_j = mechanical_energy(model, stepper->state(0));
      double most_j = 0;
      for (double at_s = 0; at_s < 2; at_s += dt_s) {
        advance(*stepper, 1);
        most_j = std::max(most_j, mechanical_energy(model, stepper->state(0)));
      }
      EXPECT_LT(most_j, 1.005 * start_j) << armature << " kg m^2 in steps of " << dt_s;
    }
  }
}

// A puck as light as public models have them (1e-5 kg/m^3): its slider's armature is ten million times its
// mass, and the slider lets it turn about no axis.
TEST(RotorContacts, move_a_light_body_on_a_slider) {
  Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "puck");
  const int puck =
      support::add_solid(model, actor, "puck", model::Shape::sphere, {0.05, 0, 0}, 4e-9, {0, 0, 0.05});
  const int slider =
      support::add_joint(model, JointKind::slider, puck, model::no_body, {0, 0, 0.05}, Vec3::UnitX());
  model.joints[static_cast<std::size_t>(slider)].armature[0] = 0.04;
  model.bodies[static_cast<std::size_t>(puck)].velocity = {0.1, 0, 0};
  for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
    const auto stepper = make_stepper(settings_with(0.01, precision), {model});
    advance(*stepper, 50);
    const Vec3& position = stepper->state(0).position[0];
    EXPECT_NEAR(position.x(), 0.05, 1e-4);
    EXPECT_NEAR(position.z(), 0.05, 1e-4);
  }
}

TEST(RotorContacts, have_the_same_bits_for_every_instruction_set) {
  std::vector<Model> worlds;
  for (const double armature : {0.01, 0.1, 1.0, 0.3, 0.03}) worlds.push_back(two_legs(armature));
  stepping::StepperSettings settings = settings_with(0.01, stepping::Precision::double_);
  std::vector<std::uint64_t> alone;
  for (const Model& model : worlds) {
    const auto stepper = make_stepper(settings, {model});
    advance(*stepper, 60);
    alone.push_back(model::hash(stepper->state(0)));
  }
  for (const stepping::Simd simd : machine_simds()) {
    settings.simd = simd;
    const auto together = make_stepper(settings, worlds);
    advance(*together, 60);
    for (std::size_t i = 0; i < worlds.size(); ++i)
      EXPECT_EQ(model::hash(together->state(static_cast<int>(i))), alone[i]) << i;
  }
}

}  // namespace
}  // namespace pbmpi::solver
