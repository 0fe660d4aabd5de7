/// Motions with an oracle that the tests of several engines measure.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/models.h"
#include "support/one_world.h"

namespace pbmpi::support {

/// A ball of radius 0.1 m, 1 m above a ground of restitution 0.8, from which it comes back to 0.64 m.
inline model::Model elastic_ball() {
  model::Model model;
  add_ground(model);
  model.geoms[0].material.restitution = 0.8;
  const int actor = add_actor(model, "ball");
  add_solid(model, actor, "ball", model::Shape::sphere, {0.1, 0, 0}, 1, {0, 0, 1.1});
  return model;
}

/// [m] How high body 0 rises after it has bounced, in 900 steps.
inline double highest_after_bounce(OneWorld& world) {
  double highest = 0;
  bool bounced = false;
  for (int step = 0; step < 900; ++step) {
    world.advance(1);
    bounced = bounced || world.state().velocity[0].z() > 0;
    if (bounced) highest = std::max(highest, world.state().position[0].z());
  }
  return highest;
}

/// [s] Time between the first two passages of x = 0 by body 0 in the same direction, in steps of `h`; 0 if
/// there are none.
inline double period_of(OneWorld& world, double h) {
  std::vector<double> passages;
  double before = world.model().bodies[0].pose.position.x();
  for (int step = 1; passages.size() < 2 && step < 20000; ++step) {
    world.advance(1);
    const double now = world.state().position[0].x();
    if (before < 0 && now >= 0) passages.push_back(h * (step - now / (now - before)));
    before = now;
  }
  return passages.size() == 2 ? passages[1] - passages[0] : 0;
}

/// [s] Period of pendulum(length, angle), to the fourth order of the angle.
inline double period_in_theory(const model::Model& pendulum, double length, double angle) {
  constexpr double g = 9.81;
  const double inertia = length * length + pendulum.bodies[0].inertia(1, 1);  // of 1 kg
  const double small = 2 * std::numbers::pi * std::sqrt(inertia / (g * length));
  return small * (1 + angle * angle / 16 + 11 * std::pow(angle, 4) / 3072);
}

/// crash() that steers, sets a motor and launches a body in its steps 5 and 40.
inline model::Model crash_with_events() {
  model::Model model = crash();
  for (const auto& [step, angle] : {std::pair{5, 0.2}, {40, -0.3}}) {
    model::Event event;
    event.step = step;
    event.kind = model::EventKind::steer;
    event.joint = 0;
    event.angle = angle;
    model.events.push_back(event);
    event.kind = model::EventKind::motor;
    event.axis = 1;
    event.motor = {30, 200};
    model.events.push_back(event);
    event.kind = model::EventKind::launch;
    event.body = 0;
    event.velocity = {10, 0, 3};
    model.events.push_back(event);
  }
  return model;
}

}  // namespace pbmpi::support
