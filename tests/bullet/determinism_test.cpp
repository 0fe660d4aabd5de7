#include <gtest/gtest.h>

#include "bullet/bullet_stepper.h"
#include "model/validate.h"
#include "simulation.h"
#include "support/models.h"
#include "support/motions.h"

namespace pbmpi::bullet {
namespace {

using model::Model;
using model::State;
using stepping::WorldStepper;

const stepping::StepperSettings settings = settings_of(0.01, 10);
constexpr int num_steps = 150;

void add(WorldStepper& stepper, int world, const Model& model) {
  stepper.add(world, std::make_shared<Model>(model), model::initial_state(model), 0);
}

void advance(WorldStepper& stepper, int steps) {
  core::PhaseTimes times;
  stepper.advance(steps, times);
}

std::uint64_t alone(int world, const Model& model) {
  const auto stepper = make_bullet_stepper(settings, "");
  add(*stepper, world, model);
  advance(*stepper, num_steps);
  return model::hash(stepper->state(world));
}

TEST(Determinism, of_the_crash_model_is_tried_where_things_happen) {
  Simulation simulation(support::crash(), settings);
  int most_contacts = 0, fewest_islands = 100;
  for (int frame = 0; frame < 50; ++frame) {
    simulation.advance(3);
    most_contacts = std::max(most_contacts, simulation.observables().contacts);
    fewest_islands = std::min(fewest_islands, simulation.observables().islands);
  }
  EXPECT_GT(most_contacts, 10);
  EXPECT_LE(fewest_islands, 2);  // the car runs into the ragdolls
  EXPECT_EQ(simulation.observables().nonfinite, 0);
}

TEST(Determinism, holds_for_worlds_alone_and_interleaved_in_any_order) {
  const auto together = make_bullet_stepper(settings, "");
  for (const int world : {7, 2, 5}) add(*together, world, support::crash(world));
  for (int step = 0; step < num_steps; ++step) advance(*together, 1);
  for (const int world : {2, 5, 7})
    EXPECT_EQ(model::hash(together->state(world)), alone(world, support::crash(world)));
}

TEST(Determinism, holds_for_what_is_left_after_a_removal) {
  const auto stepper = make_bullet_stepper(settings, "");
  for (int world = 0; world < 2; ++world) add(*stepper, world, support::crash(world));
  advance(*stepper, 20);
  stepper->remove(0);
  advance(*stepper, num_steps - 20);
  EXPECT_EQ(model::hash(stepper->state(1)), alone(1, support::crash(1)));
}

/// Steps world 0 through num_steps, and at each of `stops` moves it to a new stepper that knows only its
/// state.
std::uint64_t with_restarts(const Model& model, const std::vector<int>& stops) {
  auto stepper = make_bullet_stepper(settings, "");
  add(*stepper, 0, model);
  int step = 0;
  for (const int stop : stops) {
    advance(*stepper, stop - step);
    step = stop;
    const State state = stepper->state(0);
    stepper = make_bullet_stepper(settings, "");
    add(*stepper, 1000 + stop, support::pile(5));  // other company, so that this is not a mere repetition
    stepper->add(0, std::make_shared<Model>(model), state, stop);
  }
  advance(*stepper, num_steps - step);
  return model::hash(stepper->state(0));
}

TEST(Determinism, holds_across_a_restart_at_any_step) {
  const Model model = support::crash();
  const std::uint64_t uninterrupted = alone(0, model);
  for (const int stop : {1, 12, 30, 75})
    EXPECT_EQ(with_restarts(model, {stop}), uninterrupted) << "at step " << stop;
  EXPECT_EQ(with_restarts(model, {3, 6, 9, 12, 15, 18, 21, 100}), uninterrupted);
}

TEST(Determinism, holds_across_a_restart_of_piles_of_boxes_and_balls) {
  for (const Model& model : {support::pile(12), support::falling_balls(3, 0.5)})
    EXPECT_EQ(with_restarts(model, {20, 60, 61}), alone(0, model));
}

/// All shapes in one heap, one with an inertia that is not along its axes.
Model heap() {
  Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "heap", model::ActorKind::prop, true);
  const std::pair<model::Shape, std::array<double, 3>> kinds[] = {{model::Shape::box, {0.4, 0.3, 0.2}},
                                                                  {model::Shape::capsule, {0.1, 0.4, 0}},
                                                                  {model::Shape::cylinder, {0.15, 0.3, 0}},
                                                                  {model::Shape::sphere, {0.15, 0, 0}}};
  for (int i = 0; i < 12; ++i) {
    const auto& [shape, size] = kinds[i % 4];
    const model::Vec3 place(0.05 * (i % 3), 0.04 * (i % 2), 0.3 + 0.35 * i);
    support::add_solid(model, actor, "body" + std::to_string(i), shape, size, 1, place,
                       support::rotation(model::Vec3(1, i, 2).normalized(), 0.3 * i));
  }
  model.bodies[0].inertia(0, 1) = model.bodies[0].inertia(1, 0) = 0.002;
  return model;
}

TEST(Determinism, holds_across_a_restart_of_a_heap_of_all_shapes) {
  EXPECT_EQ(with_restarts(heap(), {1, 40, 90, 91}), alone(0, heap()));
}

/// A slider with a stop and a motor that holds its pose, and a sprung wheel with a motor, in a spin.
Model machine() {
  Model model;
  const int actor = support::add_actor(model, "machine");
  support::add_solid(model, actor, "frame", model::Shape::box, {1, 0.5, 0.2}, 20, {0, 0, 2});
  support::add_solid(model, actor, "piston", model::Shape::box, {0.2, 0.2, 0.2}, 3, {1, 0, 2});
  support::add_solid(model, actor, "wheel", model::Shape::sphere, {0.3, 0, 0}, 5, {-1, 0, 2});
  support::add_joint(model, model::JointKind::slider, 0, 1, {1, 0, 2}, model::Vec3(1, 0, 1).normalized());
  model.joints[0].limits[0] = {-0.1, 0.2};
  model.joints[0].motors[0] = {0, 30, 5};
  support::add_joint(model, model::JointKind::hinge2, 0, 2, {-1, 0, 2}, model::Vec3::UnitZ(),
                     model::Vec3::UnitY());
  model.joints[1].suspension = {900, 20};
  model.joints[1].motors = {{{0, 50, 8}, {6, 5}}};
  model.bodies[0].angular_velocity = {1, 2, 0.5};
  model.bodies[1].velocity = {1.5, 0, 0.4};
  return model;
}

TEST(Determinism, holds_across_a_restart_of_joints_that_slide_and_are_driven) {
  EXPECT_EQ(with_restarts(machine(), {1, 2, 17, 60}), alone(0, machine()));
}

TEST(Determinism, holds_for_a_state_that_is_set) {
  const Model model = heap();
  Simulation simulation(model, settings);
  simulation.advance(60);
  const State state = simulation.state();
  simulation.advance(30);
  simulation.stepper().set_state(0, state, 60);
  simulation.advance(num_steps - 60);
  EXPECT_EQ(model::hash(simulation.state()), alone(0, model));
  simulation.stepper().set_state(0, model::initial_state(model), 0);
  simulation.advance(num_steps);
  EXPECT_EQ(model::hash(simulation.state()), alone(0, model));
}

TEST(Determinism, holds_across_a_restart_among_events) {
  const Model model = support::crash_with_events();
  const std::uint64_t uninterrupted = alone(0, model);
  EXPECT_NE(uninterrupted, alone(0, support::crash()));
  for (const int stop : {4, 5, 6, 39, 40, 41, 100})
    EXPECT_EQ(with_restarts(model, {stop}), uninterrupted) << "at step " << stop;
}

}  // namespace
}  // namespace pbmpi::bullet
