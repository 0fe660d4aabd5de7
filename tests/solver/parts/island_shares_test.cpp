// Islands that get more or less of a step than most: the same bits however they are packed, cut and stopped.
#include "solver/parts/island_shares.h"

#include <gtest/gtest.h>

#include "ode/collide/narrow_phase.h"
#include "solver/parts/yards.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::solver {
namespace {

using namespace testing_support;

struct Lengths {
  const char* name;
  double tolerance_m;
  double contact_hz = model::infinity;  ///< with softer contacts the stacks are tall
  double approach_m = 0;

  StepperSettings settings() const {
    StepperSettings settings = default_settings(stepping::StepperKind::sor);
    settings.tolerance_m = tolerance_m;
    settings.approach_m = approach_m;
    settings.law.contact_frequency = contact_hz;
    return settings;
  }
};

class IslandShares : public testing::TestWithParam<Lengths> {};

INSTANTIATE_TEST_SUITE_P(Lengths, IslandShares,
                         testing::Values(Lengths{"tolerance", 3e-5}, Lengths{"tall", 0, 12},
                                         Lengths{"tall_with_tolerance", 3e-5, 12},
                                         Lengths{"approach", 0, model::infinity, 0.02},
                                         Lengths{"all", 3e-5, 12, 0.02}),
                         [](const auto& one) { return std::string(one.param.name); });

TEST_P(IslandShares, each_island_has_the_bits_of_a_run_of_its_own) {
  for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
    StepperSettings settings = GetParam().settings();
    settings.precision = precision;
    Model far_only = yards(false, true);
    const auto both = start(settings, yards(true, true)), near = start(settings, yards(true, false)),
               far = start(settings, far_only);
    for (int step = 0; step < 200; ++step) {
      for (const auto& stepper : {both.get(), near.get(), far.get()}) advance(*stepper, 1);
      const State& state = both->state(0);
      ASSERT_EQ(model::hash(part(state, 0, bodies_a_yard)),
                model::hash(part(near->state(0), 0, bodies_a_yard)))
          << "step " << step;
      ASSERT_EQ(model::hash(part(state, bodies_a_yard, bodies_a_yard)),
                model::hash(part(far->state(0), 0, bodies_a_yard)))
          << "step " << step;
      ASSERT_EQ(both->observables(0).row_visits,
                near->observables(0).row_visits + far->observables(0).row_visits);
    }
  }
}

TEST_P(IslandShares, worlds_have_the_bits_that_each_has_alone_for_every_instruction_set) {
  std::vector<Model> worlds;
  for (const int launched_at : {20, 150, 90, 25, 400, 160, 35}) worlds.push_back(yard_with_ball(launched_at));
  constexpr int num_steps = 180;
  for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
    StepperSettings settings = GetParam().settings();
    settings.precision = precision;
    std::vector<std::unique_ptr<stepping::WorldStepper>> alone;
    for (const Model& model : worlds) {
      alone.push_back(start(settings, model));
      advance(*alone.back(), num_steps);
    }
    for (const stepping::Simd simd : machine_simds()) {
      settings.simd = simd;
      const auto together = make_stepper(settings, worlds);
      advance(*together, num_steps);
      for (std::size_t i = 0; i < worlds.size(); ++i) {
        const int world = static_cast<int>(i);
        EXPECT_EQ(model::hash(together->state(world)), model::hash(alone[i]->state(0))) << i;
        EXPECT_EQ(together->observables(world).row_visits, alone[i]->observables(0).row_visits) << i;
      }
    }
  }
}

TEST_P(IslandShares, has_the_same_bits_across_a_restart_at_any_step) {
  for (const bool sleeping : {false, true}) {
    Model model = yard_with_ball(120);
    if (sleeping) model.effects["sleeping"] = true;
    constexpr int num_steps = 220;
    const auto whole = start(GetParam().settings(), model);
    advance(*whole, num_steps);
    for (const int stop : {1, 40, 100, 120, 121, 140, 190}) {
      const auto first = start(GetParam().settings(), model);
      advance(*first, stop);
      const auto second = start(GetParam().settings(), model, first->state(0), stop);
      advance(*second, num_steps - stop);
      EXPECT_EQ(model::hash(second->state(0)), model::hash(whole->state(0))) << "at step " << stop;
    }
  }
}

TEST_P(IslandShares, keeps_a_field_of_interest) {
  Model model = yards(true, true);
  model.interest = model::Interest{{0, 0, 0}, model::no_body, 5, 1};
  StepperSettings settings = GetParam().settings();
  settings.iterations = 3;
  Model far_model = yards(false, true);
  const auto both = start(settings, model), near = start(settings, yards(true, false));
  settings.iterations = 1;
  const auto far = start(settings, far_model);
  for (int step = 0; step < 150; ++step) {
    for (const auto& stepper : {both.get(), near.get(), far.get()}) advance(*stepper, 1);
    ASSERT_EQ(model::hash(part(both->state(0), 0, bodies_a_yard)),
              model::hash(part(near->state(0), 0, bodies_a_yard)))
        << step;
    ASSERT_EQ(model::hash(part(both->state(0), bodies_a_yard, bodies_a_yard)),
              model::hash(part(far->state(0), 0, bodies_a_yard)))
        << step;
  }
}

}  // namespace
}  // namespace pbmpi::solver
