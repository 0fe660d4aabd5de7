/// Friction shared by the contacts of two bodies, against the laws of a box that slides and spins.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "model/mechanics.h"
#include "solver/sor_run.h"
#include "stepping/names.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Vec3;
using stepping::Friction;
using stepping::Precision;

constexpr double mu = 0.4, gravity = 9.81;

stepping::StepperSettings settings_of(Friction friction, Precision precision = Precision::double_) {
  stepping::StepperSettings settings = default_settings(stepping::StepperKind::sor);
  settings.law.friction = friction;
  settings.precision = precision;
  settings.contacts = true;
  return settings;
}

/// A cube of 1 m and 10 kg that stands on four contacts.
model::Model cube() {
  model::Model model = support::box_over_ground(0);
  for (model::Geom& geom : model.geoms) geom.material.mu = mu;
  return model;
}

/// Friction on the cube from all contacts of the last step [N], [N m] about the cube's middle.
struct Wrench {
  Vec3 force = Vec3::Zero(), torque = Vec3::Zero();
};
Wrench friction_of(const stepping::StepContacts& step) {
  Wrench wrench;
  for (const auto& [contact, force] : step.contacts) {
    wrench.force += force.friction;
    wrench.torque += force.arm.cross(force.friction);
  }
  return wrench;
}

class Patch : public testing::TestWithParam<Precision> {};

/// Each corner resists with mu times a quarter of the weight, perpendicular to its radius from the middle.
TEST_P(Patch, brakes_a_spinning_cube_as_its_corners_would) {
  const double spin = 6;
  model::Model model = cube();
  model.bodies[0].angular_velocity = {0, 0, spin};
  const double torque = mu * 10 * gravity * std::numbers::sqrt2 / 2;
  const double expected_s = spin * model.bodies[0].inertia(2, 2) / torque;
  for (const Friction friction : {Friction::patch, Friction::cone}) {
    const auto stepper = make_stepper(settings_of(friction, GetParam()), {model});
    double turn = 0, stopped_s = 0;
    for (int step = 0; step < 100; ++step) {
      const double before = stepper->state(0).angular_velocity[0].z();
      advance(*stepper, 1);
      const double now = stepper->state(0).angular_velocity[0].z();
      turn += 0.01 * (before + now) / 2;
      if (now > 0.01) stopped_s = 0.01 * (step + 1);
      if (step == 5) {
        EXPECT_NEAR(friction_of(*stepper->contacts(0)).torque.z(), -torque, 0.01 * torque);
      }
    }
    EXPECT_NEAR(stopped_s, expected_s, 0.015) << static_cast<int>(friction);
    EXPECT_NEAR(turn, spin * expected_s / 2, 0.02 * turn) << static_cast<int>(friction);
    EXPECT_LT(stepper->state(0).angular_velocity[0].norm(), 1e-3) << static_cast<int>(friction);
  }
}

/// The centre of pressure of the step before, at today's contacts: the middle about which a patch twists.
Vec3 middle_of(const std::vector<model::LoadedContact>& now,
               const std::vector<model::LoadedContact>& before) {
  Vec3 sum = Vec3::Zero();
  double pressure = 0;
  for (const model::LoadedContact& one : now) {
    const Vec3& arm = one.force.arm;
    const auto nearest = std::ranges::min_element(
        before, {}, [&](const model::LoadedContact& old) { return (old.force.arm - arm).norm(); });
    const double weight = nearest == before.end() ? 0 : nearest->force.normal;
    sum += weight * arm;
    pressure += weight;
  }
  if (pressure > 0) return sum / pressure;
  for (const model::LoadedContact& one : now) sum += one.force.arm / static_cast<double>(now.size());
  return sum;
}

/// Force and twist are bounded together, and the contacts carry them.
TEST_P(Patch, has_a_force_and_a_twist_within_one_ellipsoid) {
  model::Model model = cube();
  model.bodies[0].velocity = {2, 1, 0};
  model.bodies[0].angular_velocity = {0, 0, 5};
  const auto stepper = make_stepper(settings_of(Friction::patch, GetParam()), {model});
  int slipping = 0;
  std::vector<model::LoadedContact> before;
  for (int step = 0; step < 80; ++step) {
    advance(*stepper, 1);
    const stepping::StepContacts& seen = *stepper->contacts(0);
    ASSERT_EQ(seen.contacts.size(), 4u) << step;
    const Vec3 middle = middle_of(seen.contacts, before);
    double normal = 0, torque = 0, reach = 0;
    for (const auto& [contact, force] : seen.contacts) {
      const Vec3 lever = force.arm - middle;
      normal += force.normal;
      reach += force.normal * lever.norm();
      torque += lever.cross(force.friction).z();
      ASSERT_LT(std::abs(force.friction.z()), 1e-5 * (1 + force.normal)) << step;
    }
    const double used = std::hypot(friction_of(seen).force.norm() / (mu * normal), torque / (mu * reach));
    ASSERT_LT(used, 1.001) << step;
    if (used > 0.999) ++slipping;
    before = seen.contacts;
  }
  EXPECT_GT(slipping, 20) << "as long as it slides";
  EXPECT_LT(slipping, 75) << "and then it stands";
}

/// A plank that leans on an edge, a little skewed: of the two points there only one carries. The remembered
/// forces hold it, so that the next step finds nothing to do.
TEST_P(Patch, remembers_forces_that_balance_a_plank_which_leans_on_one_point) {
  model::Model model;
  support::add_ground(model);
  const auto add = [&](const char* name, const std::array<double, 3>& size, double mass_kg, const Vec3& at,
                       const model::Quat& turn) {
    support::add_solid(model, support::add_actor(model, name), name, model::Shape::box, size, mass_kg, at,
                       turn);
  };
  add("block", {0.4, 1, 0.4}, 50, {0, 0, 0.2}, {});
  const auto lean = support::rotation(Vec3(0.2, 1, 0.06).normalized(), -0.6);
  add("plank", {1.2, 0.3, 0.05}, 3, {-0.34, 0.1, 0.35}, lean);
  for (model::Geom& geom : model.geoms) geom.material.mu = 0.8;
  model.gravity = {0, 2, -gravity};
  const auto stepper = make_stepper(settings_of(Friction::patch, GetParam()), {model});
  advance(*stepper, 300);
  const stepping::StepContacts& seen = *stepper->contacts(0);
  const model::State& state = stepper->state(0);
  ASSERT_LT(state.velocity[1].norm(), 1e-3);
  int idle = 0;
  Vec3 sum = 3 * model.gravity, torque = Vec3::Zero();
  for (const auto& [contact, force] : seen.contacts) {
    if (contact.body_a != 1 && contact.body_b != 1) continue;
    const double sign = contact.body_a == 1 ? 1 : -1;
    const Vec3 push = sign * (force.normal * contact.normal + force.friction);
    sum += push;
    torque += (contact.position - state.position[1]).cross(push);
    if (force.normal == 0) ++idle;
  }
  EXPECT_GT(idle, 0) << "a point of a patch carries nothing";
  EXPECT_LT(sum.norm(), 1e-3 * 3 * gravity);
  EXPECT_LT(torque.norm(), 2e-5 * 3 * gravity)
      << "a twist about the middle of both points loses 6e-5 and more";
}

/// The load on a cube that is held on a slope is known: its weight along the slope, and no twist.
TEST_P(Patch, holds_a_cube_on_a_slope_by_its_weight) {
  model::Model model = cube();
  const double slope = 0.2;
  model.gravity = gravity * Vec3(std::sin(slope), 0, -std::cos(slope));
  const auto stepper = make_stepper(settings_of(Friction::patch, GetParam()), {model});
  advance(*stepper, 200);
  const Wrench wrench = friction_of(*stepper->contacts(0));
  const double weight = 10 * gravity;
  EXPECT_NEAR(wrench.force.x(), -weight * std::sin(slope), 1e-3 * weight);
  EXPECT_NEAR(wrench.force.y(), 0, 1e-3 * weight);
  EXPECT_NEAR(wrench.torque.z(), 0, 1e-3 * weight);
  EXPECT_LT((stepper->state(0).position[0] - model.bodies[0].pose.position).norm(), 1e-3);
}

/// A cube spins on a slab that slides freely: the slab gains what the cube loses.
TEST_P(Patch, takes_from_one_body_what_it_gives_the_other) {
  model::Model model;
  support::add_ground(model);
  const auto add = [&](const char* name, const std::array<double, 3>& size, double mass_kg, const Vec3& at) {
    support::add_solid(model, support::add_actor(model, name), name, model::Shape::box, size, mass_kg, at);
  };
  add("slab", {2, 2, 0.2}, 20, {0, 0, 0.1});
  add("cube", {0.5, 0.5, 0.5}, 10, {0.3, 0.2, 0.45});
  for (model::Geom& geom : model.geoms) geom.material.mu = geom.body == model::no_body ? 0 : mu;
  model.bodies[1].angular_velocity = {0, 0, 8};
  model.bodies[1].velocity = {0.2, -0.1, 0};
  const model::State start = model::initial_state(model);
  const double before = model::angular_momentum(model, start).z();
  const auto stepper = make_stepper(settings_of(Friction::patch, GetParam()), {model});
  advance(*stepper, 100);
  const model::State& state = stepper->state(0);
  EXPECT_NEAR(model::angular_momentum(model, state).z(), before, 1e-3 * before);
  EXPECT_NEAR(state.angular_velocity[0].z(), state.angular_velocity[1].z(), 1e-3) << "they turn as one";
  EXPECT_GT(state.angular_velocity[0].z(), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Patch, Patch, testing::Values(Precision::double_, Precision::single));

/// Contacts of a body with different planes are not a patch: each has its own friction.
TEST(Patch, does_not_join_contacts_of_different_planes) {
  model::Model model;
  const int ground = support::add_actor(model, "gutter"), actor = support::add_actor(model, "ball");
  support::add_solid(model, actor, "ball", model::Shape::sphere, {0.5, 0, 0}, 10, {0, 0, 0.70710678});
  for (const double side : {-1.0, 1.0}) {
    model::Geom plane;
    plane.actor = ground;
    plane.shape = model::Shape::plane;
    plane.local.orientation = support::rotation(Vec3::UnitY(), -side * std::numbers::pi / 4);
    model.geoms.push_back(plane);
  }
  for (model::Geom& geom : model.geoms) geom.material.mu = mu;
  model.bodies[0].velocity = {0, 3, 0};
  const auto with = [&](Friction friction) {
    const auto stepper = make_stepper(settings_of(friction), {model});
    advance(*stepper, 30);
    EXPECT_EQ(stepper->contacts(0)->contacts.size(), 2u);
    return stepper->state(0);
  };
  const model::State patch = with(Friction::patch), cone = with(Friction::cone);
  EXPECT_LT((patch.velocity[0] - cone.velocity[0]).norm(), 0.02);
  EXPECT_LT((patch.angular_velocity[0] - cone.angular_velocity[0]).norm(), 0.04);
  EXPECT_LT(patch.velocity[0].y(), 2.5) << "it has been braked";
}

}  // namespace
}  // namespace pbmpi::solver
