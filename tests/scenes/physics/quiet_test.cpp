// Scenes before their action: no events, nothing moving, for 2 s.
#include <gtest/gtest.h>

#include <algorithm>

#include "../simulation.h"
#include "model/mechanics.h"

namespace pbmpi::scenes {
namespace {

constexpr double salvo_radius_m = 0.1;  // of Battle's salvo: half its boxes' height too

/// World 0 of a scene without its events and with all bodies at rest; a round in flight lies on the ground.
model::Model quiet_model(const Scene& scene) {
  model::Model model = *scene.build(0, 1);
  model.events.clear();
  for (model::Body& body : model.bodies) {
    const bool flies =
        model.actors[body.actor].kind == model::ActorKind::projectile && !body.velocity.isZero();
    if (flies) body.pose.position.z() = salvo_radius_m;
    body.velocity.setZero();
    body.angular_velocity.setZero();
  }
  return model;
}

double kinetic_energy(const model::Model& model, const model::State& state) {
  model::Model weightless = model;
  weightless.gravity.setZero();
  return model::mechanical_energy(weightless, state);
}

constexpr double most_gap_m = 5e-3;  // a thickness of clothes: no gap that a viewer sees

constexpr double most_penetration_m = 20e-3;
constexpr int num_steps = 200;  // of 0.01 s
constexpr int num_worlds = 4;   // that differ in the solver's row order alone

class Quiet : public testing::TestWithParam<const char*> {};

TEST_P(Quiet, scene_holds_together_and_comes_to_rest) {
  const auto scene = parse_scene(find_scene(GetParam()));
  const auto model = std::make_shared<model::Model>(quiet_model(*scene));
  stepping::StepperSettings settings;
  settings.dt_s = scene->defaults().dt_s;
  settings.iterations = scene->defaults().iterations;
  const auto stepper = ode::make_ode_stepper(settings, [](const std::string&) {});
  for (int world = 0; world < num_worlds; ++world) {
    stepper->add(world, model, model::initial_state(*model), 0);
  }
  core::PhaseTimes times;
  double gap_m = 0, penetration_m = 0, early_j = 0, late_j = 0;
  for (int step = 0; step < num_steps; ++step) {
    stepper->advance(1, times);
    for (int world = 0; world < num_worlds; ++world) {
      const stepping::Observables& seen = stepper->observables(world);
      gap_m = std::max(gap_m, seen.joint_gap_m);
      penetration_m = std::max(penetration_m, seen.max_penetration_m);
      const double energy_j = kinetic_energy(*model, stepper->state(world));
      if (4 * step < num_steps) early_j = std::max(early_j, energy_j);
      if (4 * step >= 3 * num_steps) late_j = std::max(late_j, energy_j);
    }
  }
  for (int world = 0; world < num_worlds; ++world) {
    EXPECT_EQ(stepper->observables(world).nonfinite, 0);
    for (int i = 0; i < model->num_bodies(); ++i) {
      if (!model->bodies[i].name.ends_with(".head")) continue;
      // Standing humans sway by up to 0.16 m; a fall takes the head down by 1.6 m.
      EXPECT_GT(stepper->state(world).position[i].z(), model->bodies[i].pose.position.z() - 0.3)
          << model->bodies[i].name;
    }
  }
  EXPECT_LT(gap_m, most_gap_m);
  EXPECT_LT(penetration_m, most_penetration_m);
  EXPECT_LT(late_j, early_j);  // decays
}

INSTANTIATE_TEST_SUITE_P(Scenes, Quiet,
                         testing::Values("2-Cars", "10-Cars", "CrashSk", "CrashWa", "Environ", "100CrSk",
                                         "Battle", "Fight", "Battle2"),
                         [](const auto& instance) {
                           std::string name = instance.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace pbmpi::scenes
