/// Worlds in which some islands rest while others move, for tests of steps in which islands differ.
#pragma once

#include <string>

#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver::testing_support {

using model::Model;
using model::State;
using stepping::StepperSettings;

/// A stack of boxes, and a chain on hinges that falls next to it and comes to rest.
inline void add_yard(Model& model, double x) {
  const std::string at = "." + std::to_string(static_cast<int>(x));
  const int wall = support::add_actor(model, "wall" + at, model::ActorKind::wall, true);
  for (int i = 0; i < 4; ++i) {
    support::add_solid(model, wall, "box" + std::to_string(i) + at, model::Shape::box, {0.5, 0.5, 0.5}, 2,
                       {x, 0, 0.25 + 0.5 * i});
  }
  const int chain = support::add_actor(model, "chain" + at);
  int previous = model::no_body;
  for (int i = 0; i < 4; ++i) {
    const int link = support::add_solid(model, chain, "link" + std::to_string(i) + at, model::Shape::box,
                                        {0.4, 0.2, 0.2}, 1, {x + 1.5 + 0.5 * i, 0.1, 0.4});
    if (previous != model::no_body) {
      support::add_joint(model, model::JointKind::hinge, link, previous, {x + 1.25 + 0.5 * i, 0.1, 0.4},
                         model::Vec3::UnitY());
      model.joints.back().limits[0] = {-0.3, 0.3};
    }
    previous = link;
  }
}

inline constexpr int bodies_a_yard = 8;

inline Model yards(bool near, bool far) {
  Model model;
  support::add_ground(model);
  if (near) add_yard(model, 0);
  if (far) add_yard(model, 30);
  return model;
}

/// A yard into whose stack a ball is thrown at this step.
inline Model yard_with_ball(int launched_at) {
  Model model = yards(true, false);
  const int actor = support::add_actor(model, "ball", model::ActorKind::projectile);
  const int ball =
      support::add_solid(model, actor, "ball", model::Shape::sphere, {0.2, 0, 0}, 5, {-3, 0, 0.2});
  model::Event event;
  event.step = launched_at;
  event.body = ball;
  event.velocity = {12, 0.1 * (launched_at % 3), 2};
  model.events.push_back(event);
  return model;
}

inline std::unique_ptr<stepping::WorldStepper> start(const StepperSettings& settings, const Model& model,
                                                     const State& state, std::int64_t step = 0) {
  auto stepper = make_stepper(settings);
  stepper->add(0, std::make_shared<const Model>(model), state, step);
  return stepper;
}

inline std::unique_ptr<stepping::WorldStepper> start(const StepperSettings& settings, const Model& model) {
  return start(settings, model, model::initial_state(model));
}

/// Rows [first, first + count) of poses and velocities.
inline State part(const State& state, int first, int count) {
  State rows;
  for (int body = first; body < first + count; ++body) {
    rows.position.push_back(state.position[body]);
    rows.orientation.push_back(state.orientation[body]);
    rows.velocity.push_back(state.velocity[body]);
    rows.angular_velocity.push_back(state.angular_velocity[body]);
  }
  return rows;
}

inline double sweeps_a_row(const stepping::WorldStepper& stepper) {
  return stepper.observables(0).row_visits / stepper.observables(0).rows;
}

}  // namespace pbmpi::solver::testing_support
