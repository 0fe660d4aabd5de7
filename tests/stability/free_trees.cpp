/// free_trees [--count N] [--seed S] [--seconds T]: N random trees of free bodies that joints of all kinds
/// hold together, from the seeds S, S + 1 ..., turn in space for T seconds with the default of sor, in double
/// and in single precision. Nothing acts on them from outside: their energy never grows by more than 1 % of
/// what they start with, from their lowest to any later one by more than 3 %, their angular momentum stays,
/// and their joints hold. A seed that fails is printed and fails the program.
#include <algorithm>
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

/// [m] A distance at which a force turns a body about as easily as it moves it.
double gyration_radius(const model::Body& body) { return std::sqrt(body.inertia.trace() / 3 / body.mass_kg); }

void add_joint(Draw& draw, Model& model, int body, int parent, const Vec3& anchor, bool bounded) {
  constexpr JointKind kinds[] = {JointKind::ball, JointKind::hinge, JointKind::slider, JointKind::universal,
                                 JointKind::fixed};
  const JointKind kind = kinds[draw.below(5)];
  const Vec3 axis = draw.direction();
  model::Joint& joint = model.joints[static_cast<std::size_t>(
      support::add_joint(model, kind, body, parent, anchor, axis, axis.unitOrthogonal()))];
  joint.name = "joint" + std::to_string(model.num_joints());
  for (const std::size_t i : {0, 1}) {
    if (traits_of(kind).axes[i].has_limit && bounded && draw.chance(0.6))
      joint.limits[i] = {draw.between(-1, -0.1), draw.between(0.1, 1)};
    if (traits_of(kind).axes[i].has_motor && !traits_of(kind).slides && draw.chance(0.1))
      joint.armature[i] = model.bodies[body].inertia.trace() * draw.scale(0.01, 3);
  }
}

/// 3 to 20 boxes of up to 1e4 to 1 in mass, with arms of up to 10 radii of gyration, that turn as one.
Model random_tree(std::uint64_t seed) {
  Draw draw(seed);
  Model model;
  model.gravity = Vec3::Zero();
  const int actor = support::add_actor(model, "tree");
  const double longest = draw.between(1, 10), ratio = draw.scale(3, 1e4);
  const bool bounded = draw.chance(0.5);
  const int count = 3 + draw.below(18);
  for (int body = 0; body < count; ++body) {
    const double x = draw.between(0.1, 0.6), y = draw.between(0.1, 0.6);
    const int parent = body == 0 ? -1 : std::max(0, body - 1 - draw.below(3));
    const int added =
        support::add_solid(model, actor, "body" + std::to_string(body), model::Shape::box,
                           {x, y, draw.between(0.1, 0.6)}, draw.scale(0.1, 0.1 * ratio), Vec3::Zero(),
                           support::rotation(draw.direction(), draw.between(0, std::numbers::pi)));
    model::Body& own = model.bodies[added];
    if (parent < 0) continue;
    const model::Body& above = model.bodies[parent];
    const Vec3 out = draw.direction();
    const Vec3 anchor = above.pose.position + out * (gyration_radius(above) * longest * draw.between(0.3, 1));
    const Vec3 onward = (out + 0.6 * draw.direction()).normalized();
    own.pose.position = anchor + onward * (gyration_radius(own) * longest * draw.between(0.3, 1));
    add_joint(draw, model, added, parent, anchor, bounded);
  }
  const Vec3 turning = draw.direction() * draw.between(0.3, 2);
  for (model::Body& body : model.bodies) {
    body.angular_velocity = turning;
    body.velocity = turning.cross(body.pose.position);
  }
  model.geoms.clear();
  return model;
}

struct Outcome {
  double gain = 0, rise = 0, momentum = 0, gap_m = 0;
  bool holds() const { return gain < 0.01 && rise < 0.03 && momentum < 0.03 && gap_m < 5e-3; }
};

Outcome run(const Model& model, stepping::Precision precision, double seconds) {
  stepping::StepperSettings settings = stepping::default_settings(stepping::StepperKind::sor);
  settings.precision = precision;
  const auto stepper = make_any_stepper(settings);
  stepper->add(0, std::make_shared<const Model>(model), initial_state(model), 0);
  const double start_j = mechanical_energy(model, stepper->state(0));
  const Vec3 start = angular_momentum(model, stepper->state(0));
  double lowest_j = start_j;
  const model::JointGaps gaps(model);
  Outcome worst;
  const auto raise = [](double& most, double value) { most = value <= most ? most : value; };  // also to NaN
  core::PhaseTimes times;
  for (double at_s = 0; at_s < seconds; at_s += settings.dt_s) {
    stepper->advance(1, times);
    const model::State& state = stepper->state(0);
    const double energy_j = mechanical_energy(model, state);
    raise(worst.gain, (energy_j - start_j) / start_j);
    raise(worst.rise, (energy_j - lowest_j) / start_j);
    raise(worst.momentum, (angular_momentum(model, state) - start).norm() / start.norm());
    raise(worst.gap_m, gaps.largest(state));
    lowest_j = std::min(lowest_j, energy_j);
  }
  return worst;
}

int run(int argc, char** argv) {
  const int count = static_cast<int>(number_option(argc, argv, "--count", 25));
  const int first = static_cast<int>(number_option(argc, argv, "--seed", 1));
  const double seconds = number_option(argc, argv, "--seconds", 5);
  const ode::Engine engine;
  int failed = 0;
  for (int seed = first; seed < first + count; ++seed) {
    const Model model = random_tree(static_cast<std::uint64_t>(seed));
    validate(model, "random tree");
    for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
      const Outcome outcome = run(model, precision, seconds);
      if (outcome.holds()) continue;
      ++failed;
      std::printf("seed %d %s: FAILED: energy +%.3g %%, rises by %.3g %%, momentum %.3g %%, gap %.3g mm\n",
                  seed, precision == stepping::Precision::single ? "single" : "double", 100 * outcome.gain,
                  100 * outcome.rise, 100 * outcome.momentum, 1e3 * outcome.gap_m);
    }
  }
  std::printf("%d free trees from seed %d on, %g s each in both precisions, FAILED %d\n", count, first,
              seconds, failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pbmpi::stability

int main(int argc, char** argv) { return pbmpi::stability::run(argc, argv); }
