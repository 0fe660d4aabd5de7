// Islands in which bodies approach each other far in a step: contacts of their own in pieces of it.
#include "solver/parts/fine_islands.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "solver/parts/yards.h"
#include "stepping/stepper_traits.h"

namespace pbmpi::solver {
namespace {

using namespace testing_support;

constexpr double speed = 30, dt_s = 0.01;

/// Two equal balls that meet head on, `gap` [m] apart, and bounce without loss; a third rests far away.
Model meeting_balls(double gap, double radius = 0.5) {
  Model model;
  model.gravity = {0, 0, 0};
  for (const int side : {-1, 1}) {
    const int actor = support::add_actor(model, side < 0 ? "left" : "right");
    const int body = support::add_solid(model, actor, side < 0 ? "left" : "right", model::Shape::sphere,
                                        {radius, 0, 0}, 1, {side * (radius + gap / 2), 0, 1});
    model.bodies[body].velocity = {-side * speed, 0, 0};
    model.geoms.back().material = {0, 1};
  }
  const int actor = support::add_actor(model, "far");
  support::add_solid(model, actor, "far", model::Shape::sphere, {radius, 0, 0}, 1, {0, 50, 1});
  return model;
}

/// [m] How far the right ball is from where it would be, after two steps.
double error_m(const StepperSettings& settings, double gap, double radius) {
  const auto stepper = start(settings, meeting_balls(gap, radius));
  advance(*stepper, 2);
  const double met_s = gap / (2 * speed);
  return std::abs(stepper->state(0).position[1].x() - (radius + speed * (2 * dt_s - met_s)));
}

/// The largest over gaps that the balls cross in the first step.
double worst_m(double approach_m, double radius) {
  StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.approach_m = approach_m;
  double worst = 0;
  for (int i = 1; i <= 19; ++i) worst = std::max(worst, error_m(settings, 0.03 * i, radius));
  return worst;
}

// Contacts are found a step too late, or a piece of one.
TEST(FineIslands, meet_nearer_to_where_they_should) {
  EXPECT_GT(worst_m(0, 0.5), speed * dt_s);
  EXPECT_LT(worst_m(0.1, 0.5), 2 * speed * dt_s / 8);
}

// Fast balls have contacts ahead of them in a whole step, and need them in a piece as well.
TEST(FineIslands, have_contacts_ahead_of_what_is_fast_in_the_step) {
  EXPECT_LT(worst_m(0, 0.1), 2 * speed * dt_s / 14);
  EXPECT_LT(worst_m(0.1, 0.1), 2 * speed * dt_s / 14);
}

TEST(FineIslands, are_only_those_of_bodies_that_approach) {
  StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.contacts = true;
  settings.approach_m = 0;
  const auto plain = start(settings, meeting_balls(0.3));
  settings.approach_m = 0.1;
  const auto fine = start(settings, meeting_balls(0.3));
  for (const auto& stepper : {plain.get(), fine.get()}) advance(*stepper, 1);
  EXPECT_NE(plain->state(0).position[1], fine->state(0).position[1]);
  EXPECT_EQ(plain->state(0).position[2], fine->state(0).position[2]);
  for (const model::LoadedContact& shown : fine->contacts(0)->contacts)
    EXPECT_FALSE(shown.contact.is_approach());
  EXPECT_EQ(fine->observables(0).contacts, static_cast<int>(fine->contacts(0)->contacts.size()));
}

// Slow worlds have the bits that they have without.
TEST(FineIslands, change_nothing_where_nothing_approaches) {
  StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.approach_m = 0;
  const auto plain = start(settings, yards(true, false));
  settings.approach_m = 0.1;
  const auto fine = start(settings, yards(true, false));
  for (const auto& stepper : {plain.get(), fine.get()}) advance(*stepper, 100);
  EXPECT_EQ(model::hash(plain->state(0)), model::hash(fine->state(0)));
}

// ODE's law has no memory with which a piece could begin.
TEST(FineIslands, need_a_memory) {
  StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.law = stepping::ode_law();
  settings.approach_m = 0;
  const auto plain = start(settings, meeting_balls(0.3));
  settings.approach_m = 0.1;
  const auto fine = start(settings, meeting_balls(0.3));
  for (const auto& stepper : {plain.get(), fine.get()}) advance(*stepper, 2);
  EXPECT_EQ(model::hash(plain->state(0)), model::hash(fine->state(0)));
}

}  // namespace
}  // namespace pbmpi::solver
