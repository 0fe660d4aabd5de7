/// Residuals against a dense recomputation that does not use rows.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "ode/collide/narrow_phase.h"
#include "solver/sor_run.h"
#include "stepping/stepper_traits.h"
#include "support/body_poses.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Vec3;
using stepping::Residuals;
using Vector = Eigen::VectorXd;

stepping::StepperSettings settings_of(int iterations) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  settings.iterations = iterations;
  settings.law.colliders = stepping::Colliders::ode;
  settings.residuals = true;
  return settings;
}

/// A ball that slides over the ground, 1 cm deep, and drags another one by a joint with a gap of 2 cm.
model::Model dragged_ball() {
  model::Model model;
  const int actor = support::add_actor(model, "balls");
  support::add_solid(model, actor, "a", model::Shape::sphere, {0.3, 0, 0}, 1, {0, 0, 0.29});
  support::add_solid(model, actor, "b", model::Shape::sphere, {0.2, 0, 0}, 2, {0.5, 0.1, 0.6});
  support::add_ground(model);
  for (model::Geom& geom : model.geoms) geom.material.mu = 0.4;
  support::add_joint(model, model::JointKind::ball, 0, 1, {0.25, 0.05, 0.4});
  model.joints[0].anchor_b += Vec3(0.01, -0.01, 0.02);
  model.bodies[0].velocity = {1.5, -0.5, -1};
  model.bodies[0].angular_velocity = {1, -2, 0.5};
  model.bodies[1].velocity = {-0.2, 0.4, 0.3};
  return model;
}

/// J v = rhs - cfm p with 3 rows of the joint, the contact's normal, and its two directions of friction.
struct Dense {
  Eigen::MatrixXd jacobian{Eigen::MatrixXd::Zero(6, 12)};
  Vector rhs{Vector::Zero(6)}, cfm{6}, inv_mass{12};
};

void set_row(Dense& dense, int row, int body, const Vec3& direction, const Vec3& arm, double sign) {
  dense.jacobian.block<1, 3>(row, 6 * body) = sign * direction.transpose();
  dense.jacobian.block<1, 3>(row, 6 * body + 3) = sign * arm.cross(direction).transpose();
}

Dense assemble(const model::Model& model, const model::Contact& contact, double h) {
  Dense dense;
  const Vec3 xa = model.bodies[0].pose.position, xb = model.bodies[1].pose.position;
  const Vec3 arm_a = model.joints[0].anchor_a, arm_b = model.joints[0].anchor_b;  // no body is turned yet
  const Vec3 apart = xb + arm_b - xa - arm_a;
  for (int k = 0; k < 3; ++k) {
    set_row(dense, k, 0, Vec3::Unit(k), arm_a, 1);
    set_row(dense, k, 1, Vec3::Unit(k), arm_b, -1);
    dense.rhs[k] = model.erp / h * apart[k];
  }
  const Vec3 directions[] = {contact.normal, -Vec3::UnitY(), Vec3::UnitX()};  // dPlaneSpace of the z axis
  for (int k = 0; k < 3; ++k) set_row(dense, 3 + k, 0, directions[k], contact.position - xa, 1);
  dense.rhs[3] = model.contact_law.soft_erp / h * contact.depth;
  dense.cfm.setConstant(model.cfm / h);
  dense.cfm[3] = model.contact_law.soft_cfm / h;
  for (int body = 0; body < 2; ++body) {
    const model::Body& source = model.bodies[static_cast<std::size_t>(body)];
    dense.inv_mass.segment<3>(6 * body).setConstant(1 / source.mass_kg);
    dense.inv_mass.segment<3>(6 * body + 3) = source.inertia.diagonal().cwiseInverse();
  }
  return dense;
}

Vector velocities(const model::State& state) {
  Vector all(12);
  for (int body = 0; body < 2; ++body) {
    all.segment<3>(6 * body) = state.velocity[static_cast<std::size_t>(body)];
    all.segment<3>(6 * body + 3) = state.angular_velocity[static_cast<std::size_t>(body)];
  }
  return all;
}

model::Contact only_contact(const model::Model& model) {
  const auto poses = support::body_poses(model);
  const model::GeomPair pair{0, 2};
  std::vector<model::Contact> contacts;
  ode::make_narrow_phase(model)->collide(poses, {&pair, 1}, contacts);
  EXPECT_EQ(contacts.size(), 1u);
  return contacts.front();
}

Residuals recompute(const model::Model& model, const model::State& after, double h) {
  const model::Contact contact = only_contact(model);
  const Dense dense = assemble(model, contact, h);
  Vector before = velocities(model::initial_state(model));
  for (int body = 0; body < 2; ++body) before.segment<3>(6 * body) += h * model.gravity;
  const Vector v = velocities(after);
  // M (v - before) = J^T p has one solution: the six rows are independent.
  const Eigen::MatrixXd pushes = dense.inv_mass.asDiagonal() * dense.jacobian.transpose();
  const Vector p = pushes.colPivHouseholderQr().solve(v - before);
  EXPECT_LT((pushes * p - (v - before)).norm(), 1e-12) << "nothing but these rows acts on the bodies";
  const Vector w = dense.jacobian * v + dense.cfm.cwiseProduct(p) - dense.rhs;
  const Vector d = (dense.jacobian * pushes).diagonal() + dense.cfm;
  Residuals residuals;
  residuals.joint_speed = residuals.natural_speed = w.head<3>().cwiseAbs().maxCoeff();
  residuals.complementarity_j = std::abs(p[3] * w[3]);
  const double bound = contact.mu * p[3];
  for (int row = 3; row < 6; ++row) {
    const double low = row == 3 ? 0 : -bound, high = row == 3 ? INFINITY : bound;
    const double change = std::clamp(p[row] - w[row] / d[row], low, high) - p[row];
    residuals.natural_speed = std::max(residuals.natural_speed, std::abs(change * d[row]));
  }
  return residuals;
}

TEST(Residuals, are_those_of_a_dense_recomputation) {
  const model::Model model = dragged_ball();
  for (const int iterations : {1, 2, 5, 20}) {
    const stepping::StepperSettings settings = settings_of(iterations);
    const auto stepper = make_stepper(settings, {model});
    advance(*stepper, 1);
    const Residuals found = stepper->observables(0).residuals;
    const Residuals expected = recompute(model, stepper->state(0), settings.dt_s);
    // Speeds of about 1 m/s and impulses of 1 N s through a well-conditioned 6 x 6 system.
    EXPECT_NEAR(found.joint_speed, expected.joint_speed, 1e-11) << iterations;
    EXPECT_NEAR(found.complementarity_j, expected.complementarity_j, 1e-11) << iterations;
    EXPECT_NEAR(found.natural_speed, expected.natural_speed, 1e-11) << iterations;
    EXPECT_EQ(found.joint_turn, 0) << "a ball joint has no row about an axis";
    EXPECT_EQ(found.natural_turn, 0);
    if (iterations < 5) {
      EXPECT_GT(found.natural_speed, 1e-4) << "there is something to measure";
    }
  }
}

TEST(Residuals, are_those_of_the_solve_before_damping) {
  model::Model model = dragged_ball();
  const auto free = make_stepper(settings_of(3), {model});
  model.linear_damping = model.angular_damping = 5;
  const auto damped = make_stepper(settings_of(3), {model});
  advance(*free, 1);
  advance(*damped, 1);
  EXPECT_LT(damped->state(0).velocity[0].norm(), free->state(0).velocity[0].norm());
  EXPECT_EQ(damped->observables(0).residuals.joint_speed, free->observables(0).residuals.joint_speed);
  EXPECT_EQ(damped->observables(0).residuals.natural_speed, free->observables(0).residuals.natural_speed);
}

TEST(Residuals, vanish_with_many_iterations_for_every_kind_of_row) {
  const auto stepper = make_stepper(settings_of(4000), {support::crash()});
  advance(*stepper, 1);
  const Residuals& residuals = stepper->observables(0).residuals;
  // Box friction converges slowly: the remainder is at most a thousandth of the least that one sweep leaves.
  for (const double residual : {residuals.joint_speed, residuals.joint_turn, residuals.natural_speed,
                                residuals.natural_turn, residuals.complementarity_j}) {
    EXPECT_LT(residual, 1e-6);
  }
  const auto rough = make_stepper(settings_of(1), {support::crash()});
  advance(*rough, 1);
  EXPECT_GT(rough->observables(0).residuals.joint_speed, 1e-3);
  EXPECT_GT(rough->observables(0).residuals.natural_turn, 1e-3);
}

TEST(Residuals, are_the_same_for_every_width_and_only_measured_when_asked_for) {
  std::vector<model::Model> worlds;
  for (int variant = 0; variant < 5; ++variant) worlds.push_back(support::crash(variant));
  stepping::StepperSettings settings = settings_of(20);
  std::vector<Residuals> expected;
  for (const stepping::Simd simd : machine_simds()) {
    settings.simd = simd;
    const auto stepper = make_stepper(settings, worlds);
    advance(*stepper, 15);
    for (int world = 0; world < 5; ++world) {
      const Residuals& seen = stepper->observables(world).residuals;
      if (simd == machine_simds().front()) expected.push_back(seen);
      const Residuals& first = expected[static_cast<std::size_t>(world)];
      EXPECT_EQ(seen.joint_speed, first.joint_speed);
      EXPECT_EQ(seen.joint_turn, first.joint_turn);
      EXPECT_EQ(seen.complementarity_j, first.complementarity_j);
      EXPECT_EQ(seen.natural_speed, first.natural_speed);
      EXPECT_EQ(seen.natural_turn, first.natural_turn);
    }
  }
  EXPECT_NE(expected[0].natural_speed, expected[1].natural_speed) << "each world has its own";
  settings.residuals = false;
  const auto stepper = make_stepper(settings, worlds);
  advance(*stepper, 15);
  EXPECT_EQ(stepper->observables(0).residuals.natural_speed, 0);
}

}  // namespace
}  // namespace pbmpi::solver
