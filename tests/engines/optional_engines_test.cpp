#include "engines/optional_engines.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "engines/stepper_factory.h"
#include "stepping/names.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::engines {
namespace {

using stepping::StepperKind;

TEST(OptionalEngines, are_bullet_and_mujoco) {
  EXPECT_EQ(optional_engines().size(), 2);
  EXPECT_EQ(find_optional_engine(StepperKind::bullet)->name, "Bullet");
  EXPECT_EQ(find_optional_engine(StepperKind::mujoco)->name, "MuJoCo");
  for (const StepperKind kind : {StepperKind::quick, StepperKind::direct, StepperKind::sor}) {
    EXPECT_EQ(find_optional_engine(kind), nullptr);
    EXPECT_NO_THROW(require_in_build(kind, "--stepper"));
    EXPECT_TRUE(inexpressible(kind, support::crash()).empty());
  }
}

TEST(OptionalEngines, that_are_left_out_are_refused_with_what_to_do) {
  OptionalEngine engine = optional_engines().front();
  engine.version = "";
  EXPECT_FALSE(engine.in_build());
  EXPECT_EQ(absence_text(engine),
            "this build has no stepper bullet, since Bullet was not there or not wanted when it was "
            "configured; install libbullet-dev and configure anew (-DPBMPI_BULLET=ON), or use sor, quick or "
            "direct");
}

TEST(OptionalEngines, step_if_they_are_in_the_build_and_are_refused_if_not) {
  for (const OptionalEngine& engine : optional_engines()) {
    const std::string name(name_of(engine.stepper));
    EXPECT_NE(builds_text().find(name), std::string::npos);
    if (!engine.in_build()) {
      EXPECT_THROW(require_in_build(engine.stepper, "--stepper " + name), core::InputError);
      EXPECT_THROW(make_stepper(default_settings(engine.stepper)), core::InputError);
      continue;
    }
    EXPECT_NO_THROW(require_in_build(engine.stepper, "--stepper " + name));
    EXPECT_NE(builds_text().find(name + " (" + std::string(engine.name)), std::string::npos);
    const auto stepper = make_stepper(default_settings(engine.stepper));
    const model::Model model = support::free_box();
    stepper->add(0, std::make_shared<model::Model>(model), model::initial_state(model), 0);
    core::PhaseTimes times;
    stepper->advance(10, times);
    EXPECT_LT(stepper->state(0).velocity[0].z(), model.bodies[0].velocity.z());
  }
}

TEST(OptionalEngines, have_iterations_of_their_own) {
  EXPECT_EQ(stepping::default_iterations(StepperKind::quick, stepping::Law::ode, 33), 33);
  EXPECT_EQ(stepping::default_iterations(StepperKind::bullet, stepping::Law::ode, 33), 10);
  EXPECT_EQ(stepping::default_iterations(StepperKind::mujoco, stepping::Law::ode, 33), 100);
  EXPECT_EQ(default_settings(StepperKind::bullet).iterations, 10);
}

}  // namespace
}  // namespace pbmpi::engines
