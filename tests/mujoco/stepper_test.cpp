#include "mujoco/mujoco_stepper.h"

#include <cmath>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.h"
#include "simulation.h"
#include "support/models.h"

namespace pbmpi::mujoco {
namespace {

using model::Model;

void add(stepping::WorldStepper& stepper, int world, const Model& model) {
  stepper.add(world, std::make_shared<Model>(model), model::initial_state(model), 0);
}

TEST(MujocoStepper, refuses_settings_that_step_nothing) {
  EXPECT_THROW(make_mujoco_stepper(settings_with(0)), core::InputError);
  EXPECT_THROW(make_mujoco_stepper(settings_with(-0.01)), core::InputError);
  EXPECT_THROW(make_mujoco_stepper(settings_with(std::nan(""))), core::InputError);
  stepping::StepperSettings settings = settings_with();
  settings.iterations = 0;
  EXPECT_THROW(make_mujoco_stepper(settings), core::InputError);
}

TEST(MujocoStepper, tells_where_the_time_went_and_what_was_solved) {
  const auto stepper = make_mujoco_stepper(settings_with());
  add(*stepper, 0, support::crash());
  add(*stepper, 1, support::free_box());
  core::PhaseTimes times;
  const double start = core::now_s();
  stepper->advance(10, times);
  const double elapsed = core::now_s() - start;
  EXPECT_GT(times[core::Phase::collide], 0);
  EXPECT_GT(times[core::Phase::solve], 0);
  EXPECT_LE(times.useful_s(), elapsed);
  EXPECT_GT(stepper->cost_s(0), 0);
  const stepping::Observables& seen = stepper->observables(0);
  EXPECT_GT(seen.contacts, 0);
  EXPECT_GE(seen.rows, 3 * seen.contacts);
  EXPECT_GE(seen.row_visits, seen.rows);
  EXPECT_EQ(seen.islands, 3) << "a car and two ragdolls that do not touch yet";
  EXPECT_LE(seen.max_island_rows, seen.rows);
  EXPECT_EQ(stepper->observables(1).islands, 1);
}

TEST(MujocoStepper, shows_a_world_that_is_not_finite_and_steps_the_others) {
  Model wild = support::free_box();
  model::Event launch;
  launch.step = 5;
  launch.body = 0;
  launch.velocity = {1, 2, 3};
  launch.angular_velocity = {1e11, 1e12, -1e11};  // the torque of such a spin is beyond MuJoCo's numbers
  wild.events.push_back(launch);
  const auto stepper = make_mujoco_stepper(settings_with());
  add(*stepper, 0, wild);
  add(*stepper, 1, support::free_box());
  core::PhaseTimes times;
  stepper->advance(5, times);
  EXPECT_EQ(stepper->observables(0).nonfinite, 0);
  testing::internal::CaptureStderr();
  stepper->advance(5, times);
  const std::string warning = testing::internal::GetCapturedStderr();
  EXPECT_NE(warning.find("world 0, step 5"), std::string::npos) << warning;
  EXPECT_EQ(stepper->observables(0).nonfinite, 1);
  const std::uint64_t frozen = model::hash(stepper->state(0));
  stepper->advance(5, times);
  EXPECT_EQ(model::hash(stepper->state(0)), frozen);
  EXPECT_EQ(model::hash(stepper->state(1)), hash_after(support::free_box(), 15));
  EXPECT_FALSE(std::filesystem::exists("MUJOCO_LOG.TXT")) << "MuJoCo's own place for warnings";
  stepper->set_state(0, model::initial_state(wild), 0);
  stepper->advance(1, times);
  EXPECT_EQ(stepper->observables(0).nonfinite, 0) << "a state from elsewhere brings it back";
}

TEST(MujocoStepper, takes_in_a_state_that_is_not_finite) {
  const Model model = support::free_box();
  model::State state = model::initial_state(model);
  state.velocity[0].x() = std::numeric_limits<double>::quiet_NaN();
  const auto stepper = make_mujoco_stepper(settings_with());
  stepper->add(0, std::make_shared<Model>(model), state, 0);
  core::PhaseTimes times;
  stepper->advance(3, times);
  EXPECT_TRUE(std::isnan(stepper->state(0).velocity[0].x()));
}

TEST(MujocoStepper, makes_room_for_contacts_that_come_later) {
  Model model = support::pile(6);  // has room for 64 contacts and 4 a geom at first, and for no rows
  for (model::Body& body : model.bodies) body.pose.position.z() += 0.5;
  for (int i = 1; i < 6; ++i) model.bodies[static_cast<std::size_t>(i)].pose.position.z() += 0.2 * i;
  Simulation simulation(model);
  simulation.advance(1);
  EXPECT_EQ(simulation.observables().contacts, 0);
  simulation.advance(200);
  EXPECT_GE(simulation.observables().contacts, 20);
  EXPECT_EQ(simulation.observables().nonfinite, 0);
  EXPECT_EQ(hash_after(model, 60), hash_after_restore(model, 30, 30)) << "room moves no bit";
}

}  // namespace
}  // namespace pbmpi::mujoco
