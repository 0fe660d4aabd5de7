/// Steps whose sweeps end with Newton's method, against steps of very many sweeps.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.h"
#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Vec3;
using stepping::Law;
using stepping::StepperSettings;

StepperSettings with_memory(int iterations, Law law) {
  StepperSettings settings = default_settings(stepping::StepperKind::sor, law);
  settings.iterations = iterations;
  settings.law.sor_factor = 1;
  settings.law.warm_start = 1;
  settings.law.friction = stepping::Friction::cone;
  settings.residuals = true;
  return settings;
}

/// A box that slides over the ground on one edge and drags another one by a hinge with a limit.
model::Model dragged_box() {
  model::Model model;
  const int actor = support::add_actor(model, "boxes");
  const int a = support::add_solid(model, actor, "a", model::Shape::box, {0.4, 0.3, 0.2}, 3, {0, 0, 0.22},
                                   support::rotation(Vec3::UnitY(), 0.5));
  const int b = support::add_solid(model, actor, "b", model::Shape::box, {0.3, 0.5, 0.2}, 2, {0.5, 0.1, 0.6});
  support::add_ground(model);
  for (model::Geom& geom : model.geoms) geom.material.mu = 0.4;
  support::add_joint(model, model::JointKind::hinge, a, b, {0.25, 0.05, 0.4}, Vec3::UnitY());
  model.joints[0].limits[0] = {-0.01, 0.01};
  model.bodies[static_cast<std::size_t>(a)].velocity = {1.5, -0.5, -1};
  model.bodies[static_cast<std::size_t>(b)].angular_velocity = {0.1, 4, -0.2};
  return model;
}

double largest_difference(const model::State& a, const model::State& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.velocity.size(); ++i) {
    largest = std::max({largest, (a.velocity[i] - b.velocity[i]).cwiseAbs().maxCoeff(),
                        (a.angular_velocity[i] - b.angular_velocity[i]).cwiseAbs().maxCoeff()});
  }
  return largest;
}

TEST(Coulomb, is_where_very_many_sweeps_lead) {
  const model::Model model = dragged_box();
  const auto few = make_stepper(with_memory(5, Law::coulomb), {model});
  const auto many = make_stepper(with_memory(40000, Law::ode), {model});
  for (int step = 0; step < 12; ++step) {
    advance(*few, 1);
    advance(*many, 1);
  }
  // [m/s, rad/s] for speeds of a few units; the sweeps leave the larger error.
  EXPECT_LT(largest_difference(few->state(0), many->state(0)), 1e-7);
}

TEST(Coulomb, leaves_far_smaller_residuals_of_a_crash) {
  const auto plain = make_stepper(with_memory(100, Law::ode), {support::crash()});
  const auto finished = make_stepper(with_memory(100, Law::coulomb), {support::crash()});
  double most_plain = 0, most_finished = 0;
  for (int step = 0; step < 20; ++step) {
    advance(*plain, 1);
    advance(*finished, 1);
    const stepping::Residuals &left = plain->observables(0).residuals,
                              &now = finished->observables(0).residuals;
    most_plain = std::max({most_plain, left.natural_speed, left.natural_turn});
    most_finished = std::max({most_finished, now.natural_speed, now.natural_turn, now.joint_speed});
  }
  EXPECT_GT(most_plain, 1e-3);
  EXPECT_LT(most_finished, 1e-6);  // [m/s, rad/s] of some 10; measured 1.6e-8
}

TEST(Coulomb, has_the_same_bits_in_any_lanes) {
  for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
    std::vector<std::uint64_t> hashes;
    for (const stepping::Simd simd : machine_simds()) {
      StepperSettings settings = with_memory(10, Law::coulomb);
      settings.precision = precision;
      settings.simd = simd;
      settings.substeps = 2;
      const auto stepper =
          make_stepper(settings, {support::crash(0), dragged_box(), support::crash(1), dragged_box()});
      advance(*stepper, 4);
      std::uint64_t hash = 0;
      for (int world = 0; world < 4; ++world) hash = 31 * hash + model::hash(stepper->state(world));
      EXPECT_EQ(model::hash(stepper->state(1)), model::hash(stepper->state(3)));
      hashes.push_back(hash);
    }
    for (const std::uint64_t hash : hashes) EXPECT_EQ(hash, hashes.front());
  }
}

TEST(Coulomb, is_of_rigid_rows_with_cones_alone) {
  const auto refused = [](auto change) {
    StepperSettings settings = with_memory(10, Law::coulomb);
    change(settings);
    EXPECT_THROW(make_stepper(settings), core::InputError);
  };
  refused([](StepperSettings& settings) { settings.law.relax = 1; });
  refused([](StepperSettings& settings) { settings.law.contact_frequency = 60; });
  refused([](StepperSettings& settings) { settings.law.joint_frequency = 60; });
  refused([](StepperSettings& settings) { settings.law.friction = stepping::Friction::pyramid; });
}

}  // namespace
}  // namespace pbmpi::solver
