/// landings [--count N] [--seed S] [--seconds T]: N random legged robots, from the seeds S, S + 1 ..., fall
/// on a plane: a torso on 2 to 6 legs of 1 to 3 links, whose joints have armatures of up to 1000 times the
/// link's inertia, and limits; with sor in double and in single precision, in steps of 2 to 17 ms. Nothing
/// drives them, so that their energy never grows by more than 1 %, and their joints hold. A seed that fails
/// is printed and fails the program.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/clock.h"
#include "guarded_run.h"
#include "model/joint_gap.h"
#include "model/joint_traits.h"
#include "model/mechanics.h"
#include "model/validate.h"
#include "number_option.h"
#include "ode/objects/engine.h"
#include "random_model.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::stability {
namespace {

using model::JointKind;
using model::Model;
using model::Vec3;

/// A link from `start` on, which hangs on the body `parent` there.
int add_link(Draw& draw, Model& model, int actor, int parent, const Vec3& start, const Vec3& along) {
  const double length = draw.between(0.1, 0.5), width = draw.between(0.02, 0.08);
  const Vec3 centre = start + along * (0.5 * length + width);
  const auto turn = model::Quat::from_eigen(Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), along));
  const int link =
      support::add_solid(model, actor, "link" + std::to_string(model.num_bodies()), model::Shape::box,
                         {length, width, width}, draw.scale(0.02, 1), centre, turn);
  constexpr std::array kinds = {JointKind::hinge, JointKind::hinge, JointKind::hinge, JointKind::universal,
                                JointKind::slider};
  const JointKind kind = kinds[static_cast<std::size_t>(draw.below(kinds.size()))];
  const Vec3 across = along.cross(draw.direction()).normalized();
  const Vec3 axis = traits_of(kind).slides ? along : across;
  model::Joint& joint = model.joints[static_cast<std::size_t>(
      support::add_joint(model, kind, link, parent, start, axis, axis.unitOrthogonal()))];
  joint.name = "joint" + std::to_string(model.num_joints());
  for (const std::size_t i : {0, 1}) {
    const auto& traits = traits_of(kind).axes[i];
    const double reach = traits_of(kind).slides ? 0.1 : 1;
    if (traits.has_limit && draw.chance(0.7))
      joint.limits[i] = {-reach * draw.between(0, 1), reach * draw.between(0, 1)};
    const double inertia =
        traits_of(kind).slides ? model.bodies[link].mass_kg : model.bodies[link].inertia.trace();
    if (traits.has_motor && draw.chance(0.8)) joint.armature[i] = inertia * draw.scale(0.1, 1000);
  }
  return link;
}

Model random_robot(std::uint64_t seed) {
  Draw draw(seed);
  Model model;
  support::add_ground(model);
  const int actor = support::add_actor(model, "robot");
  const double radius = draw.between(0.08, 0.25);
  const int torso = support::add_solid(model, actor, "torso", model::Shape::sphere, {radius, 0, 0},
                                       draw.scale(0.2, 10), Vec3::Zero());
  const int legs = 2 + draw.below(5);
  for (int leg = 0; leg < legs; ++leg) {
    const double heading = 2 * std::numbers::pi * leg / legs, down = draw.between(-1, 0.3);
    const Vec3 along = Vec3(std::cos(heading), std::sin(heading), down).normalized();
    Vec3 start = along * (radius + 0.02);
    int parent = torso;
    for (int links = 1 + draw.below(3); links > 0; --links) {
      const int link = add_link(draw, model, actor, parent, start, along);
      start = start + (model.bodies[link].pose.position - start) * 2;
      parent = link;
    }
  }
  double lowest = 0;
  for (const model::Body& body : model.bodies) lowest = std::min(lowest, body.pose.position.z() - 0.35);
  const Vec3 lift(0, 0, draw.between(0.01, 1) - lowest),
      speed = Vec3(draw.between(-3, 3), draw.between(-3, 3), 0),
      turning = draw.direction() * draw.between(0, 3);
  for (model::Body& body : model.bodies) {
    body.velocity = speed + turning.cross(body.pose.position);
    body.angular_velocity = turning;
    body.pose.position = body.pose.position + lift;
  }
  return model;
}

struct Outcome {
  double gain = 0, gap_m = 0;
  bool holds() const { return gain < 0.01 && gap_m < 0.02; }
};

Outcome run(const Model& model, const stepping::StepperSettings& settings, double seconds) {
  const auto stepper = make_any_stepper(settings);
  stepper->add(0, std::make_shared<const Model>(model), initial_state(model), 0);
  const double start_j = mechanical_energy(model, stepper->state(0));
  const model::JointGaps gaps(model);
  Outcome worst;
  const auto raise = [](double& most, double value) { most = value <= most ? most : value; };  // also to NaN
  core::PhaseTimes times;
  for (double at_s = 0; at_s < seconds; at_s += settings.dt_s) {
    stepper->advance(1, times);
    const model::State& state = stepper->state(0);
    raise(worst.gain, (mechanical_energy(model, state) - start_j) / start_j);
    raise(worst.gap_m, gaps.largest(state));
  }
  return worst;
}

int run(int argc, char** argv) {
  const int count = static_cast<int>(number_option(argc, argv, "--count", 25));
  const int first = static_cast<int>(number_option(argc, argv, "--seed", 1));
  const double seconds = number_option(argc, argv, "--seconds", 3);
  const ode::Engine engine;
  int failed = 0;
  for (int seed = first; seed < first + count; ++seed) {
    const Model model = random_robot(static_cast<std::uint64_t>(seed));
    validate(model, "random robot");
    constexpr std::array steps_s = {0.002, 0.005, 0.01, 1.0 / 60};
    stepping::StepperSettings settings = stepping::default_settings(stepping::StepperKind::sor);
    settings.dt_s = steps_s[static_cast<std::size_t>(seed) % steps_s.size()];
    for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
      settings.precision = precision;
      const Outcome outcome = run(model, settings, seconds);
      if (outcome.holds()) continue;
      ++failed;
      std::printf("seed %d %s, dt %.3g: FAILED: energy +%.3g %%, gap %.3g mm\n", seed,
                  precision == stepping::Precision::single ? "single" : "double", settings.dt_s,
                  100 * outcome.gain, 1e3 * outcome.gap_m);
    }
  }
  std::printf("%d robots from seed %d on land, %g s each in both precisions, FAILED %d\n", count, first,
              seconds, failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pbmpi::stability

int main(int argc, char** argv) { return pbmpi::stability::run(argc, argv); }
