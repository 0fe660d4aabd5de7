#include "ode/stepper.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.h"
#include "ode/ode_stepper.h"
#include "simulation.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

// The memory that SolverResources::abandon() leaks is not a leak that a change here could fix.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:dThreadingAllocateSelfThreadedImplementation\nleak:PreallocateJobInfos\n";
}

namespace pbmpi::ode {
namespace {

using model::Model;

void add(stepping::WorldStepper& stepper, int world, const Model& model) {
  stepper.add(world, std::make_shared<Model>(model), model::initial_state(model), 0);
}

TEST(OdeStepper, refuses_settings_that_step_nothing) {
  EXPECT_THROW(make_ode_stepper({stepping::StepperKind::quick, 0, 20, 1}), core::InputError);
  EXPECT_THROW(make_ode_stepper({stepping::StepperKind::quick, -0.01, 20, 1}), core::InputError);
  EXPECT_THROW(make_ode_stepper({stepping::StepperKind::quick, std::nan(""), 20, 1}), core::InputError);
  EXPECT_THROW(make_ode_stepper({stepping::StepperKind::quick, model::infinity, 20, 1}), core::InputError);
  EXPECT_THROW(make_ode_stepper({stepping::StepperKind::quick, 0.01, 0, 1}), core::InputError);
}

TEST(OdeStepper, knows_a_world_from_its_adding_to_its_removal) {
  const auto stepper = make_ode_stepper(default_settings(stepping::StepperKind::quick), fail_on_warning);
  EXPECT_THROW(stepper->state(3), std::logic_error);
  const Model model = support::free_box();
  add(*stepper, 3, model);
  EXPECT_EQ(model::hash(stepper->state(3)), model::hash(model::initial_state(model)));
  EXPECT_EQ(stepper->model(3).bodies[0].name, "box");
  EXPECT_THROW(add(*stepper, 3, model), std::logic_error);
  stepper->remove(3);
  EXPECT_THROW(stepper->remove(3), std::logic_error);
  add(*stepper, 3, model);
  EXPECT_EQ(stepper->state(3).num_bodies(), 1);
}

TEST(OdeStepper, drops_what_another_stepper_remembered) {
  const auto stepper = make_ode_stepper(default_settings(stepping::StepperKind::quick), fail_on_warning);
  const auto model = std::make_shared<const Model>(support::box_over_ground(0.1));
  model::State remembering = model::initial_state(*model);
  remembering.memory.contacts.push_back({{0, 1}, 0, model::no_body, {0, 0, -0.5}, 98});
  stepper->add(0, model, remembering, 0);
  EXPECT_TRUE(stepper->state(0).memory.empty());
  stepper->set_state(0, remembering, 0);
  core::PhaseTimes times;
  stepper->advance(2, times);
  EXPECT_TRUE(stepper->state(0).memory.empty());
}

TEST(OdeStepper, tells_where_the_time_went) {
  const auto stepper = make_ode_stepper(default_settings(stepping::StepperKind::quick), fail_on_warning);
  add(*stepper, 0, support::crash());
  add(*stepper, 1, support::free_box());
  core::PhaseTimes times;
  const double start = core::now_s();
  stepper->advance(30, times);
  const double elapsed = core::now_s() - start;
  EXPECT_GT(times[core::Phase::collide], 0);
  EXPECT_GT(times[core::Phase::solve], 0);
  EXPECT_GT(times[core::Phase::islands], 0);
  EXPECT_LE(times.useful_s(), elapsed);
  EXPECT_GT(stepper->cost_s(0), 0);
  EXPECT_GT(stepper->cost_s(1), 0);
  EXPECT_LE(stepper->cost_s(0) + stepper->cost_s(1), elapsed);
}

TEST(OdeStepper, spends_no_time_on_collisions_that_the_model_has_not) {
  const auto stepper = make_ode_stepper(default_settings(stepping::StepperKind::quick), fail_on_warning);
  add(*stepper, 0, support::free_box());
  core::PhaseTimes times;
  stepper->advance(10, times);
  EXPECT_EQ(times[core::Phase::collide], 0);
  EXPECT_EQ(stepper->observables(0).contacts, 0);
}

TEST(OdeStepper, steps_nothing_in_no_steps) {
  const auto stepper = make_ode_stepper(default_settings(stepping::StepperKind::quick), fail_on_warning);
  const Model model = support::free_box();
  add(*stepper, 0, model);
  core::PhaseTimes times;
  stepper->advance(0, times);
  EXPECT_EQ(model::hash(stepper->state(0)), model::hash(model::initial_state(model)));
}

class Nan : public testing::TestWithParam<stepping::StepperKind> {};
INSTANTIATE_TEST_SUITE_P(OdeStepper, Nan,
                         testing::Values(stepping::StepperKind::quick, stepping::StepperKind::direct));

TEST_P(Nan, in_one_world_is_shown_and_leaves_the_others_alone) {
  const stepping::StepperSettings settings = default_settings(GetParam());
  std::vector<std::string> lines;
  const auto stepper = make_ode_stepper(settings, [&](const std::string& line) { lines.push_back(line); });
  const Model model = support::crash();
  model::State spoilt = model::initial_state(model);
  spoilt.velocity[3].x() = std::numeric_limits<double>::quiet_NaN();
  add(*stepper, 0, model);
  stepper->add(1, std::make_shared<Model>(model), spoilt, 0);
  add(*stepper, 2, model);
  core::PhaseTimes times;
  for (int frame = 0; frame < 10; ++frame) stepper->advance(3, times);
  EXPECT_GE(stepper->observables(1).nonfinite, 1);
  const auto stops = [](const std::string& line) {
    return line.find("ode: world 1, step 0: this world stops here") == 0;
  };
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(), stops), 1);
  for (const int world : {0, 2}) {
    EXPECT_EQ(stepper->observables(world).nonfinite, 0);
    EXPECT_EQ(model::hash(stepper->state(world)), hash_after(model, settings, world, 30));
  }
}

TEST(OdeStepper, reports_how_often_the_direct_solver_complained) {
  std::vector<std::string> lines;
  const auto sink = [&](const std::string& line) { lines.push_back(line); };
  testing::internal::CaptureStderr();
  {
    // A tall stack of equal boxes: many redundant contacts, on which ODE's LCP solver is known to fail.
    Model model;
    support::add_ground(model);
    const int actor = support::add_actor(model, "stack", model::ActorKind::wall, true);
    for (int i = 0; i < 20; ++i) {
      support::add_solid(model, actor, "box" + std::to_string(i), model::Shape::box, {1, 1, 1}, 1,
                         {0, 0, 0.4999 + 0.9999 * i});
    }
    const auto stepper = make_ode_stepper({stepping::StepperKind::direct, 0.01, 1, 1}, sink);
    add(*stepper, 0, model);
    core::PhaseTimes times;
    stepper->advance(20, times);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  ASSERT_FALSE(lines.empty());
  EXPECT_NE(lines[0].find("ode: world 0, step "), std::string::npos) << lines[0];
  EXPECT_NE(lines[0].find("LCP internal error"), std::string::npos) << lines[0];
}

}  // namespace
}  // namespace pbmpi::ode
