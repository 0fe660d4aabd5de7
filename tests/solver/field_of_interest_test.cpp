// The effect "field_of_interest" in the steppers that iterate: quick and sor.
#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>

#include "effects/effects.h"
#include "ode/collide/narrow_phase.h"
#include "ode/ode_stepper.h"
#include "solver/sor_run.h"
#include "solver/worlds/sor_stepper.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Interest;
using model::Model;
using model::State;
using stepping::StepperKind;
using stepping::StepperSettings;

constexpr int bodies_a_yard = 8;
constexpr double between_yards_m = 30;

/// Four boxes that fall into a pile, and four on hinges with limits that fall on it.
void add_yard(Model& model, double x) {
  const std::string at = "." + std::to_string(static_cast<int>(x));
  const int wall = support::add_actor(model, "wall" + at, model::ActorKind::wall, true);
  for (int i = 0; i < 4; ++i) {
    support::add_solid(model, wall, "box" + std::to_string(i) + at, model::Shape::box, {0.5, 0.5, 0.5}, 2,
                       {x + 0.05 * (i % 3), 0.04 * (i % 4), 0.26 + 0.52 * i});
  }
  const int chain = support::add_actor(model, "chain" + at);
  int previous = model::no_body;
  for (int i = 0; i < 4; ++i) {
    const int link = support::add_solid(model, chain, "link" + std::to_string(i) + at, model::Shape::box,
                                        {0.4, 0.2, 0.2}, 1, {x + 0.3 + 0.5 * i, 0.1, 2.3});
    if (previous != model::no_body) {
      support::add_joint(model, model::JointKind::hinge, link, previous, {x + 0.05 + 0.5 * i, 0.1, 2.3},
                         model::Vec3::UnitY());
      model.joints.back().limits[0] = {-0.3, 0.3};
    }
    previous = link;
  }
}

/// One yard at the origin, which is of interest, and one far from it.
Model yards(bool near, bool far, const Interest& interest = {{0, 0, 0}, model::no_body, 5, 4}) {
  Model model;
  support::add_ground(model);
  if (near) add_yard(model, 0);
  if (far) add_yard(model, between_yards_m);
  model.interest = interest;
  return model;
}

/// Both yards, and a ball that the field follows and that is thrown from one to the other at this step.
Model yards_with_ball(int launched_at, bool sleeping = false) {
  Model model = yards(true, true);
  const int actor = support::add_actor(model, "ball", model::ActorKind::projectile);
  const int ball = support::add_solid(model, actor, "ball", model::Shape::sphere, {0.3, 0, 0}, 30,
                                      {5, 0.1 * (launched_at % 3), 0.3});
  model.interest = Interest{{0, 0, 0}, ball, 6, 3};
  model::Event event;
  event.step = launched_at;
  event.body = ball;
  event.velocity = {25, 0, 2};
  model.events.push_back(event);
  if (sleeping) model.effects["sleeping"] = true;
  return model;
}

std::unique_ptr<stepping::WorldStepper> start(const StepperSettings& settings, const Model& model,
                                              const State& state, std::int64_t step = 0) {
  auto stepper = settings.kind == StepperKind::sor
                     ? std::unique_ptr<stepping::WorldStepper>(make_stepper(settings))
                     : ode::make_ode_stepper(settings, [](const std::string&) {});
  stepper->add(0, std::make_shared<const Model>(model), state, step);
  return stepper;
}

std::unique_ptr<stepping::WorldStepper> start(const StepperSettings& settings, const Model& model) {
  return start(settings, model, model::initial_state(model));
}

/// Rows [first, first + count) of a state.
State part(const State& state, int first, int count) {
  State rows;
  for (int body = first; body < first + count; ++body) {
    rows.position.push_back(state.position[body]);
    rows.orientation.push_back(state.orientation[body]);
    rows.velocity.push_back(state.velocity[body]);
    rows.angular_velocity.push_back(state.angular_velocity[body]);
  }
  return rows;
}

struct Case {
  const char* name;
  StepperKind kind;
  stepping::Precision precision;
  int substeps;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

class FieldOfInterest : public testing::TestWithParam<Case> {
 protected:
  StepperSettings settings(int iterations = 20) const {
    StepperSettings settings = default_settings(GetParam().kind, stepping::Law::ode);
    settings.precision = GetParam().precision;
    settings.substeps = GetParam().substeps;
    settings.iterations = iterations;
    return settings;
  }
  std::uint64_t hash_after(int num_steps, const Model& model, int iterations = 20) const {
    const auto stepper = start(settings(iterations), model);
    advance(*stepper, num_steps);
    return model::hash(stepper->state(0));
  }
};

INSTANTIATE_TEST_SUITE_P(
    Steppers, FieldOfInterest,
    testing::Values(Case{"quick", StepperKind::quick, stepping::Precision::double_, 1},
                    Case{"sor", StepperKind::sor, stepping::Precision::double_, 1},
                    Case{"sor_substeps", StepperKind::sor, stepping::Precision::double_, 3},
                    Case{"sor_single", StepperKind::sor, stepping::Precision::single, 1}),
    [](const auto& instance) { return instance.param.name; });

// QuickStep shuffles the rows of one call with one sequence of random numbers, which the call's other islands
// share: only the same set of islands gives the same bits.
TEST_P(FieldOfInterest, gives_each_island_the_bits_of_a_run_of_its_own_with_its_iterations) {
  const auto both = start(settings(), yards(true, true));
  const auto near = start(settings(20), yards(true, false));
  Model far_model = yards(false, true);
  far_model.interest.reset();
  const auto far = start(settings(4), far_model);
  for (int step = 0; step < 60; ++step) {
    advance(*both, 1);
    advance(*near, 1);
    advance(*far, 1);
    const State& state = both->state(0);
    ASSERT_EQ(model::hash(part(state, 0, bodies_a_yard)), model::hash(near->state(0))) << "step " << step;
    ASSERT_EQ(model::hash(part(state, bodies_a_yard, bodies_a_yard)), model::hash(far->state(0)))
        << "step " << step;
    const stepping::Observables &seen = both->observables(0), &a = near->observables(0),
                                &b = far->observables(0);
    ASSERT_EQ(seen.contacts, a.contacts + b.contacts);
    ASSERT_EQ(seen.rows, a.rows + b.rows);
    ASSERT_EQ(seen.islands, a.islands + b.islands);
    ASSERT_EQ(seen.bodies_inside, bodies_a_yard);
  }
  EXPECT_GT(both->observables(0).contacts, 10) << "piles have formed";
}

TEST_P(FieldOfInterest, changes_no_bit_where_it_holds_everything) {
  Model plain = yards(true, true);
  plain.interest.reset();
  const std::uint64_t expected = hash_after(60, plain);
  EXPECT_EQ(hash_after(60, yards(true, true, {{0, 0, 0}, model::no_body, 100, 4})), expected);
  EXPECT_NE(hash_after(60, yards(true, true)), expected) << "and does change some where it does not";
}

TEST_P(FieldOfInterest, changes_no_bit_where_it_gives_all_iterations_outside) {
  Model plain = yards(true, true);
  plain.interest.reset();
  const std::uint64_t expected = hash_after(60, plain);
  for (const int outside : {20, 50})
    EXPECT_EQ(hash_after(60, yards(true, true, {{0, 0, 0}, model::no_body, 5, outside})), expected);
}

TEST_P(FieldOfInterest, changes_no_bit_where_it_is_demanded_of_a_model_without) {
  Model plain = yards(true, true);
  plain.interest.reset();
  Model demanded = plain;
  demanded.effects["field_of_interest"] = true;
  ASSERT_TRUE(effects::StepPlan(demanded).is_idle(effects::EffectId::field_of_interest));
  EXPECT_EQ(hash_after(60, demanded), hash_after(60, plain));
}

TEST_P(FieldOfInterest, that_holds_nothing_is_a_run_with_few_iterations) {
  Model plain = yards(true, true);
  plain.interest.reset();
  const Model empty = yards(true, true, {{0, 500, 0}, model::no_body, 5, 4});
  EXPECT_EQ(hash_after(60, empty), hash_after(60, plain, 4));
  EXPECT_EQ(hash_after(60, empty, 3), hash_after(60, plain, 3)) << "never more than the run has";
}

/// The premise of the tests that follow: both yards enter the field, and leave it.
TEST_P(FieldOfInterest, moves_with_the_body_that_it_follows) {
  const auto stepper = start(settings(), yards_with_ball(20));
  std::vector<int> inside;
  for (int step = 0; step < 150; ++step) {
    advance(*stepper, 1);
    inside.push_back(stepper->observables(0).bodies_inside);
  }
  EXPECT_EQ(inside.front(), bodies_a_yard + 1) << "the ball lies beside the first yard";
  const auto alone = std::find(inside.begin(), inside.end(), 1);
  ASSERT_NE(alone, inside.end()) << "it flies alone";
  EXPECT_GE(*std::max_element(alone, inside.end()), 3) << "it comes to the second";
}

TEST_P(FieldOfInterest, has_the_same_bits_across_a_restart_at_any_step) {
  for (const bool sleeping : {false, true}) {
    const Model model = yards_with_ball(100, sleeping);
    constexpr int num_steps = 180;
    const auto whole = start(settings(), model);
    advance(*whole, num_steps);
    for (const int stop : {1, 40, 90, 100, 101, 110, 125, 150}) {
      const auto first = start(settings(), model);
      advance(*first, stop);
      const auto second = start(settings(), model, first->state(0), stop);
      advance(*second, num_steps - stop);
      EXPECT_EQ(model::hash(second->state(0)), model::hash(whole->state(0))) << "at step " << stop;
    }
  }
}

// Batches of lanes hold bodies from inside and outside, and of other worlds.
TEST(FieldOfInterestInPacks, worlds_have_the_bits_that_each_has_alone_for_every_instruction_set) {
  for (const bool sleeping : {false, true}) {
    std::vector<Model> worlds;
    for (const int launched_at : {20, 50, 90, 25, 400, 60, 35})
      worlds.push_back(yards_with_ball(launched_at, sleeping));
    constexpr int num_steps = 130;
    for (const stepping::Precision precision : {stepping::Precision::double_, stepping::Precision::single}) {
      StepperSettings settings = default_settings(StepperKind::sor, stepping::Law::ode);
      settings.precision = precision;
      settings.residuals = true;
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
          const stepping::Observables &seen = together->observables(world), &same = alone[i]->observables(0);
          EXPECT_EQ(seen.rows, same.rows) << i;
          EXPECT_EQ(seen.bodies_inside, same.bodies_inside) << i;
          EXPECT_EQ(seen.residuals.joint_speed, same.residuals.joint_speed) << i;
          EXPECT_EQ(seen.residuals.natural_speed, same.residuals.natural_speed) << i;
        }
      }
    }
  }
}

TEST(FieldOfInterestDirect, is_idle_where_nothing_iterates) {
  StepperSettings settings = default_settings(StepperKind::direct);
  Model plain = yards(true, true);
  plain.interest.reset();
  const auto with = start(settings, yards(true, true)), without = start(settings, plain);
  advance(*with, 20);
  advance(*without, 20);
  EXPECT_EQ(model::hash(with->state(0)), model::hash(without->state(0)));
  EXPECT_EQ(with->observables(0).bodies_inside, 0);
}

}  // namespace
}  // namespace pbmpi::solver
