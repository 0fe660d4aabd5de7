#include "random_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "model/joint_traits.h"
#include "stepping/stepper_traits.h"
#include "support/models.h"

namespace pbmpi::stability {
namespace {

using model::JointKind;
using model::Model;
using model::Shape;
using model::Vec3;

constexpr double fastest = 200;  ///< [m/s]

model::Quat random_turn(Draw& draw) {
  const Vec3 axis = draw.direction();
  return support::rotation(axis, draw.between(0, 2 * std::numbers::pi));
}

std::array<double, 3> random_size(Draw& draw, Shape shape) {
  const auto length = [&] { return draw.scale(0.05, 1); };
  if (shape == Shape::sphere) return {length(), 0, 0};
  if (shape == Shape::box) {
    const double x = length(), y = length();
    return {x, y, length()};
  }
  const double radius = draw.scale(0.03, 0.4);
  return {radius, length(), 0};
}

void add_random_body(Draw& draw, Model& model, int actor) {
  const auto shape = static_cast<Shape>(draw.below(4));  // a plane has no body
  const auto size = random_size(draw, shape);
  const double mass_kg = draw.scale(1e-2, 1e2);
  const Vec3 position = draw.in_box(2) + Vec3(0, 0, 2.2);
  const int body = support::add_solid(model, actor, "body" + std::to_string(model.num_bodies()), shape, size,
                                      mass_kg, position, random_turn(draw));
  if (draw.chance(0.5)) model.bodies[body].velocity = draw.direction() * draw.scale(0.1, fastest);
  if (draw.chance(0.3)) model.bodies[body].angular_velocity = draw.direction() * draw.scale(0.1, 100);
  model.geoms.back().material = {draw.between(0, 1.5), draw.chance(0.3) ? draw.between(0, 1) : 0};
}

model::AxisMotor random_motor(Draw& draw, bool may_hold) {
  model::AxisMotor motor;
  motor.velocity = draw.between(-20, 20);
  motor.max_force = draw.scale(0.1, 1e5);
  if (may_hold && draw.chance(0.3)) motor.hold_rate = draw.scale(1, 1e3);
  return motor;
}

void add_random_joint(Draw& draw, Model& model) {
  const auto kind = static_cast<JointKind>(draw.below(model::num_joint_kinds));
  const model::JointTraits& traits = model::traits_of(kind);
  const int a = draw.below(model.num_bodies());
  int b = draw.below(model.num_bodies() + 1) - 1;
  if (b == a || (b == model::no_body && traits.needs_two_bodies)) return;
  const Vec3 anchor = model.bodies[a].pose.position + draw.in_box(0.5);
  const Vec3 axis1 = draw.direction();
  const Vec3 axis2 = axis1.unitOrthogonal();
  model::Joint& joint =
      model.joints[static_cast<std::size_t>(support::add_joint(model, kind, a, b, anchor, axis1, axis2))];
  joint.name = "joint" + std::to_string(model.num_joints());
  for (const std::size_t axis : {0, 1}) {
    if (traits.axes[axis].has_limit && draw.chance(0.4)) {
      joint.limits[axis].low = draw.between(-1.5, 0);
      joint.limits[axis].high = draw.between(0, 1.5);
    }
    if (traits.axes[axis].has_motor && draw.chance(0.4))
      joint.motors[axis] = random_motor(draw, traits.axes[axis].has_limit);
  }
  if (traits.has_suspension() && draw.chance(0.7))
    joint.suspension = {draw.scale(10, 1e6), draw.scale(0.1, 1e4)};
  if (draw.chance(0.2)) joint.break_force = draw.scale(1, 1e5);
}

void add_random_event(Draw& draw, Model& model) {
  model::Event event;
  event.step = draw.below(60);
  const int joint = model.joints.empty() ? -1 : draw.below(model.num_joints());
  const bool has_motor = joint >= 0 && traits_of(model.joints[joint].kind).axes[0].has_motor;
  if (has_motor && draw.chance(0.5)) {
    event.kind = model::EventKind::motor;
    event.joint = joint;
    event.motor = random_motor(draw, false);
  } else {
    event.body = draw.below(model.num_bodies());
    event.velocity = draw.direction() * draw.scale(1, fastest);
    if (draw.chance(0.5)) event.pose = model::Pose{draw.in_box(2) + Vec3(0, 0, 3), random_turn(draw)};
  }
  model.events.push_back(event);
}

void add_random_static(Draw& draw, Model& model) {
  model::Geom geom;
  geom.actor = support::add_actor(model, "static" + std::to_string(model.actors.size()));
  geom.size = random_size(draw, Shape::box);
  geom.size[0] *= 4;
  geom.local = {draw.in_box(2) + Vec3(0, 0, 1), random_turn(draw)};
  model.geoms.push_back(geom);
}

/// An actor of a scene file, as the lines that its type needs.
std::string random_actor(Draw& draw) {
  std::ostringstream text;
  const double mass = draw.scale(0.1, 1e3);
  switch (draw.below(8)) {
    case 0:
      text << "type = \"car\"\nspeed = " << draw.between(0, 60) << "\n";
      break;
    case 1:
      text << "type = \"human\"\ntone = " << draw.between(0, 1) << "\n";
      break;
    case 2:
      text << "type = \"centipede\"\nsegments = " << 2 + draw.below(5) << "\n";
      break;
    case 3:
      text << "type = \"wall\"\nlength = 2\nheight = 1\nblock = [0.5, 0.25, 0.25]\n";
      break;
    case 4:
      text << "type = \"tank\"\n";
      break;
    case 5:
      text << "type = \"box\"\nsize = [" << draw.scale(0.1, 2) << ", " << draw.scale(0.1, 2)
           << ", 0.5]\nmass = " << mass << "\n";
      break;
    case 6:
      text << "type = \"sphere\"\nradius = " << draw.scale(0.1, 1) << "\nmass = " << mass << "\n";
      break;
    default:
      text << "type = \"capsule\"\nradius = 0.2\nlength = " << draw.scale(0.1, 2) << "\nmass = " << mass
           << "\n";
  }
  return text.str();
}

}  // namespace

double Draw::scale(double low, double high) { return low * std::pow(high / low, unit()); }

Vec3 Draw::direction() {
  Vec3 vector = in_box(1);
  while (vector.norm() < 0.1 || vector.norm() > 1) vector = in_box(1);
  return vector.normalized();
}

Model random_model(std::uint64_t seed) {
  Draw draw(seed);
  Model model;
  if (draw.chance(0.8)) support::add_ground(model);
  for (int i = draw.below(4); i > 0; --i) add_random_static(draw, model);
  const int num_bodies = 1 + draw.below(20);
  int actor = support::add_actor(model, "actor0", model::ActorKind::prop, draw.chance(0.5));
  for (int i = 0; i < num_bodies; ++i) {
    if (draw.chance(0.3))
      actor = support::add_actor(model, "actor" + std::to_string(i + 1), model::ActorKind::prop,
                                 draw.chance(0.5));
    add_random_body(draw, model, actor);
  }
  for (int i = draw.below(2 * num_bodies); i > 0; --i) add_random_joint(draw, model);
  for (int i = draw.below(4); i > 0; --i) add_random_event(draw, model);
  std::ranges::stable_sort(model.events, {}, &model::Event::step);
  if (draw.chance(0.2)) model.effects["sleeping"] = true;
  if (draw.chance(0.2)) model.gravity = draw.direction() * draw.between(0, 20);
  return model;
}

std::string random_scene(std::uint64_t seed) {
  Draw draw(seed);
  std::ostringstream text;
  text << "title = \"random\"\n[[actor]]\nname = \"ground\"\ntype = \"ground\"\n";
  const int num_actors = 1 + draw.below(5);
  for (int i = 0; i < num_actors; ++i) {
    const Vec3 velocity = draw.chance(0.7) ? Vec3(draw.direction() * draw.scale(0.1, fastest)) : Vec3::Zero();
    text << "[[actor]]\nname = \"actor" << i << "\"\n"
         << random_actor(draw) << "position = [" << 8 * (i % 3) << ", " << 8 * (i / 3) << ", "
         << draw.between(0.6, 3) << "]\nheading = " << draw.between(-180, 180) << "\nvelocity = ["
         << velocity.x() << ", " << velocity.y() << ", " << velocity.z() << "]\n";
  }
  return text.str();
}

stepping::StepperSettings random_settings(std::uint64_t seed, stepping::StepperKind kind) {
  Draw draw(~seed);
  stepping::StepperSettings settings = default_settings(kind, stepping::Law::ode);
  settings.dt_s = draw.chance(0.5) ? 0.01 : draw.scale(1e-3, 0.05);
  settings.iterations = 1 + draw.below(30);
  settings.seed = seed;
  if (kind != stepping::StepperKind::sor) return settings;
  settings.substeps = draw.chance(0.5) ? 1 : 1 + draw.below(8);
  settings.precision = draw.chance(0.5) ? stepping::Precision::single : stepping::Precision::double_;
  if (settings.substeps > 1 && draw.chance(0.5)) settings.law.warm_start = draw.between(0, 1);
  return settings;
}

}  // namespace pbmpi::stability
