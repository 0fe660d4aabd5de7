/// impacts [--count N] [--seed S]: N random bodies, from the seeds S, S + 1 ..., hit a face: spheres, boxes,
/// capsules and cylinders at all angles and speeds, with all frictions and restitutions, with sor in double
/// and in single precision. Nothing else acts on them, so that their momenta tell what the impact did:
/// friction is at most mu times the normal impulse, and that if they slide all along (Coulomb's law over the
/// whole impact); energy never grows; spheres leave as the laws of impact say. A seed that fails is printed
/// and fails the program.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

#include "core/clock.h"
#include "guarded_run.h"
#include "model/mechanics.h"
#include "model/names.h"
#include "model/validate.h"
#include "number_option.h"
#include "ode/objects/engine.h"
#include "random_model.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::stability {
namespace {

using model::Model;
using model::Shape;
using model::Vec3;

/// A body that is about to hit a face, and what the oracle needs of it.
struct Impact {
  Model model;  ///< body 0 hits; body 1, if there is one, has the face
  stepping::StepperSettings settings;
  Vec3 normal = Vec3::UnitZ(), along = Vec3::UnitX();  ///< of the face; unit, at right angles
  double mu = 0, restitution = 0;
  double across_speed = 0, along_speed = 0;  ///< [m/s] towards the face, and along it
  double spin = 0;                           ///< [rad/s] about normal x along, of spheres
  double radius = 0;                         ///< [m] of spheres, else 0
  double touch_s = 0;
  bool slides = false;  ///< so fast that it slides throughout
};

std::array<double, 3> random_size(Draw& draw, Shape shape) {
  const double size = draw.scale(0.02, 0.5);
  if (shape == Shape::sphere) return {size, 0, 0};
  if (shape == Shape::box) return {2 * size, size * draw.between(0.7, 2), size * draw.between(0.7, 2)};
  return {size, size * draw.between(1, 3), 0};
}

/// [m] How far the body reaches from its centre towards the face.
double reach_of(const Model& model, const Vec3& normal) {
  const model::Geom& geom = model.geoms.front();
  const Vec3 axes = model.bodies.front().pose.orientation.to_eigen().conjugate() * normal;
  const double end = std::abs(axes.z());
  switch (geom.shape) {
    case Shape::sphere:
      return geom.size[0];
    case Shape::capsule:
      return geom.size[0] + 0.5 * geom.size[1] * end;
    case Shape::cylinder:
      return 0.5 * geom.size[1] * end + geom.size[0] * std::sqrt(std::max(0.0, 1 - end * end));
    default:
      return 0.5 *
             (std::abs(axes.x()) * geom.size[0] + std::abs(axes.y()) * geom.size[1] + end * geom.size[2]);
  }
}

/// Adds what is hit: a static plane, a static box or a free plate, whose face goes through the origin.
void add_face(Draw& draw, Impact& impact) {
  Model& model = impact.model;
  const int kind = draw.below(3);
  const auto turn = core::Quat::from_eigen(Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), impact.normal));
  if (kind == 2) {
    const double mass_kg = model.bodies.front().mass_kg * draw.scale(3, 1000);
    support::add_solid(model, support::add_actor(model, "plate"), "plate", Shape::box, {40, 40, 1}, mass_kg,
                       -0.5 * impact.normal, turn);
    return;
  }
  model::Geom geom;
  geom.actor = support::add_actor(model, "face");
  geom.shape = kind == 0 ? Shape::plane : Shape::box;
  geom.size = {400, 400, 1};
  geom.local.orientation = turn;
  if (kind == 1) geom.local.position = -0.5 * impact.normal;
  model.geoms.push_back(geom);
}

Impact random_impact(std::uint64_t seed) {
  constexpr Shape shapes[] = {Shape::sphere, Shape::box, Shape::capsule, Shape::cylinder};
  constexpr double steps_s[] = {0.002, 0.005, 0.01, 1.0 / 60};
  Draw draw(seed);
  Impact impact;
  Model& model = impact.model;
  model.gravity = Vec3::Zero();
  impact.normal = draw.direction();
  impact.along = impact.normal.unitOrthogonal();
  impact.mu = draw.between(0.05, 0.8);
  impact.restitution = draw.chance(0.4) ? 0 : draw.between(0.1, 0.9);
  const Shape shape = draw.chance(0.4) ? Shape::sphere : shapes[draw.below(4)];
  support::add_solid(model, support::add_actor(model, "body"), "body", shape, random_size(draw, shape),
                     draw.scale(0.01, 1000), Vec3::Zero(),
                     support::rotation(draw.direction(), draw.between(0, std::numbers::pi)));
  add_face(draw, impact);
  for (model::Geom& geom : model.geoms) geom.material = {impact.mu, impact.restitution};

  impact.across_speed = draw.scale(1, 30);
  impact.slides = draw.chance(0.5);
  const double most_change = impact.mu * (1 + impact.restitution) * impact.across_speed;
  const double fast = 8 * std::max(most_change, impact.across_speed);
  impact.along_speed = impact.slides ? 5 + fast * draw.between(1, 1.5) : draw.between(0, 40);
  model::Body& body = model.bodies.front();
  body.velocity = impact.along_speed * impact.along - impact.across_speed * impact.normal;
  if (shape == Shape::sphere) {
    impact.radius = model.geoms.front().size[0];
    impact.spin = impact.slides ? 0 : draw.between(-20, 20) / impact.radius;
    body.angular_velocity = impact.spin * impact.normal.cross(impact.along);
  } else if (!impact.slides) {
    body.angular_velocity = draw.direction() * draw.between(0, 20);
  }
  impact.touch_s = draw.between(0.01, 0.05);
  body.pose.position =
      (reach_of(model, impact.normal) + impact.across_speed * impact.touch_s) * impact.normal -
      impact.along_speed * impact.touch_s * impact.along;

  impact.settings = stepping::default_settings(stepping::StepperKind::sor);
  impact.settings.dt_s = steps_s[draw.below(4)];
  if (draw.chance(0.3)) impact.settings.law.friction = stepping::Friction::cone;
  return impact;
}

std::string text_of(const Impact& impact) {
  const auto shape = [&](int geom) {
    return std::string(name_of(impact.model.geoms[static_cast<std::size_t>(geom)].shape));
  };
  char text[200];
  std::snprintf(text, sizeof(text), "%s at %.3g m/s, %.3g along, on %s%s, mu %.2f, e %.2f, dt %.3g, %s",
                shape(0).c_str(), impact.across_speed, impact.along_speed,
                impact.model.num_bodies() > 1 ? "free " : "", shape(1).c_str(), impact.mu, impact.restitution,
                impact.settings.dt_s,
                impact.settings.law.friction == stepping::Friction::cone ? "cone" : "patch");
  return text;
}

/// Of the impulses of an impact [N s] and the energy, each divided by what it must not exceed.
struct Outcome {
  double sliding = 0;                         ///< friction over its bound
  double lacking = 0;                         ///< of the bound, where the body slides throughout
  double across = 0, along = 0, turning = 0;  ///< of spheres: what their laws say less what was
  double gain = 0;
  bool holds() const {
    return sliding < 1.05 && lacking < 0.05 && across < 0.05 && along < 0.05 && turning < 0.05 && gain < 1e-3;
  }
};

/// What a sphere gets along the face, and what its surface gets to move: it slides, or it sticks with 2/7 of
/// the speed of its surface.
void judge_sphere(const Impact& impact, double across, double along, double spin, Outcome& outcome) {
  const model::Body& own = impact.model.bodies.front();
  const bool is_free = impact.model.num_bodies() > 1;
  const double other_kg = is_free ? impact.model.bodies[1].mass_kg : model::infinity;
  const double reduced_kg = 1 / (1 / own.mass_kg + 1 / other_kg);
  const double right = (1 + impact.restitution) * impact.across_speed * reduced_kg;
  outcome.across = std::abs(across / right - 1);
  if (is_free && !impact.slides) return;  // the plate moves under the sphere
  const double slip = impact.along_speed - impact.radius * impact.spin;
  const double sticking = 2.0 / 7 * own.mass_kg * std::abs(slip);
  const double friction = std::min(impact.mu * right, sticking) * (slip > 0 ? -1 : 1);
  outcome.along = std::abs(along - friction) / (impact.mu * right);
  const double turned = own.inertia.trace() / 3 * (spin - impact.spin);
  outcome.turning = std::abs(turned + impact.radius * along) / (impact.mu * right * impact.radius);
}

Outcome run(const Impact& impact, stepping::Precision precision) {
  stepping::StepperSettings settings = impact.settings;
  settings.precision = precision;
  const auto stepper = make_any_stepper(settings);
  const Model& model = impact.model;
  stepper->add(0, std::make_shared<const Model>(model), initial_state(model), 0);
  const double start_j = mechanical_energy(model, stepper->state(0));
  Outcome outcome;
  core::PhaseTimes times;
  constexpr double longest_s = 0.5;
  for (double at_s = 0, end_s = longest_s; at_s < end_s; at_s += settings.dt_s) {
    stepper->advance(1, times);
    const double gain = mechanical_energy(model, stepper->state(0)) / start_j - 1;
    outcome.gain = gain <= outcome.gain ? outcome.gain : gain;  // also to NaN
    const double slowed = (stepper->state(0).velocity[0] - model.bodies.front().velocity).norm();
    if (end_s == longest_s && slowed > 0.1 * impact.across_speed) end_s = at_s + 0.01 + 2 * settings.dt_s;
  }
  const model::State& state = stepper->state(0);
  const model::Body& body = model.bodies.front();
  const Vec3 impulse = body.mass_kg * (state.velocity[0] - body.velocity);
  const double across = impulse.dot(impact.normal), along = impulse.dot(impact.along);
  const double bound = impact.mu * across;
  outcome.sliding = (impulse - across * impact.normal).norm() / bound;
  if (!(bound > 0)) outcome.sliding = model::infinity;
  if (impact.slides) outcome.lacking = 1 + along / bound;
  if (impact.radius > 0)
    judge_sphere(impact, across, along, state.angular_velocity[0].dot(impact.normal.cross(impact.along)),
                 outcome);
  return outcome;
}

int run(int argc, char** argv) {
  const int count = static_cast<int>(number_option(argc, argv, "--count", 25));
  const int first = static_cast<int>(number_option(argc, argv, "--seed", 1));
  const ode::Engine engine;
  int failed = 0;
  for (int seed = first; seed < first + count; ++seed) {
    const Impact impact = random_impact(static_cast<std::uint64_t>(seed));
    validate(impact.model, "random impact");
    for (const auto precision : {stepping::Precision::double_, stepping::Precision::single}) {
      const Outcome outcome = run(impact, precision);
      if (outcome.holds()) continue;
      ++failed;
      std::printf(
          "seed %d %s: FAILED: friction %.3f of its bound, lacks %.3f; sphere: across %.3f, along %.3f, "
          "turning %.3f off; energy +%.3g (%s)\n",
          seed, precision == stepping::Precision::single ? "single" : "double", outcome.sliding,
          outcome.lacking, outcome.across, outcome.along, outcome.turning, outcome.gain,
          text_of(impact).c_str());
    }
  }
  std::printf("%d impacts from seed %d on in both precisions, FAILED %d\n", count, first, failed);
  return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pbmpi::stability

int main(int argc, char** argv) { return pbmpi::stability::run(argc, argv); }
