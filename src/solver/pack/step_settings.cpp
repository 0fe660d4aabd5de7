#include "solver/pack/step_settings.h"

#include <algorithm>

#include "core/error.h"
#include "core/random.h"
#include "geometry/hulls/surface_contacts.h"
#include "solver/pack/simd.h"

namespace pbmpi::solver {

using model::Event;
using model::EventKind;

void require_valid(const stepping::StepperSettings& settings) {
  core::require_input(settings.dt_s > 0, "a step must be longer than 0 s");
  core::require_input(settings.iterations >= 1, "the solver needs at least 1 iteration");
  core::require_input(settings.threads >= 1, "the worlds are stepped by at least 1 thread");
  core::require_input(settings.substeps >= 1, "a step has at least 1 substep");
  core::require_input(settings.tolerance_m >= 0, "the tolerance of a step is a length, or 0 for none");
  core::require_input(settings.approach_m >= 0,
                      "what bodies may approach in a step is a length, or 0 for any");
  core::require_input(settings.law.warm_start >= 0 && settings.law.warm_start <= 1,
                      "warm start: the share of the impulses to take over is 0 to 1");
  const stepping::SorLaw& law = settings.law;
  const bool is_rigid = law.relax == 0 && law.contact_frequency == 0 && law.joint_frequency == 0;
  core::require_input(!law.newton || (is_rigid && law.friction == stepping::Friction::cone),
                      "Newton's method solves rigid rows with cones of friction: it needs --law coulomb");
  core::require_input(has_simd(settings.simd),
                      "this machine, or this build (PBMPI_SIMD), lacks the instruction set asked for with "
                      "--simd; use auto, or build anew with jobs/build.sh");
}

double most_approach_m(const stepping::StepperSettings& settings) {
  return remembers(settings) && settings.approach_m > 0 ? settings.approach_m : model::infinity;
}

void start_memory(bool remembers, const model::Model& model, model::StepMemory& memory) {
  if (remembers) {
    memory.joints.resize(model.joints.size());
  } else {
    memory.clear();
  }
}

double contact_margin_m(const stepping::StepperSettings& settings, const model::Model& model) {
  return settings.law.contact_margin * model.gravity.norm() * settings.dt_s * settings.dt_s;
}

std::unique_ptr<model::NarrowPhase> make_fallback(const stepping::StepperSettings& settings,
                                                  const model::Model& model,
                                                  const model::MakeNarrowPhase& make_other) {
  const bool lanes_collide = settings.law.colliders == stepping::Colliders::lanes;
  return geometry::with_surfaces(make_other(model), model,
                                 lanes_collide ? contact_margin_m(settings, model) : 0);
}

Spring contact_spring(const stepping::StepperSettings& settings) {
  return {settings.law.contact_frequency, settings.law.contact_damping, most_contact_periods};
}

Spring joint_place_spring(const stepping::StepperSettings& settings) {
  return {settings.law.joint_frequency, settings.law.joint_damping, most_place_periods};
}

Spring joint_turn_spring(const stepping::StepperSettings& settings) {
  return {settings.law.joint_frequency, settings.law.joint_damping, most_turn_periods};
}

StepParameters step_parameters(const stepping::StepperSettings& settings, std::int64_t step) {
  StepParameters parameters;
  parameters.dt_s = settings.dt_s;
  parameters.substeps = parameters.all_substeps = settings.substeps;
  parameters.iterations = settings.iterations;
  parameters.sor_factor = settings.law.sor_factor;
  parameters.warm_start = settings.law.warm_start;
  parameters.relax = settings.law.relax;
  parameters.contacts = contact_spring(settings);
  parameters.joint_places = joint_place_spring(settings);
  parameters.joint_turns = joint_turn_spring(settings);
  parameters.joint_solver = settings.law.joint_solver;
  parameters.newton = settings.law.newton;
  parameters.friction = settings.law.friction;
  parameters.residuals = settings.residuals;
  parameters.show_forces = settings.contacts;
  parameters.shuffled = settings.law.row_order == stepping::RowOrder::shuffled;
  parameters.order_key = core::mix_key(settings.seed, static_cast<std::uint64_t>(step), 0);
  return parameters;
}

void apply_setting(const Event& event, int world, Pack& pack) {
  if (event.kind == EventKind::motor) pack.set_motor(world, event.joint, event.axis, event.motor);
  if (event.kind == EventKind::steer) pack.set_limit(world, event.joint, 0, {event.angle, event.angle});
}

Event velocity_event(int body, const model::State& state) {
  Event event;
  event.kind = EventKind::launch;
  event.body = body;
  event.velocity = state.velocity[static_cast<std::size_t>(body)];
  event.angular_velocity = state.angular_velocity[static_cast<std::size_t>(body)];
  return event;
}

void apply_first_settings(const model::Model& model, int world, Pack& pack) {
  for (int joint = 0; joint < model.num_joints(); ++joint) {
    const model::Joint& held = model.joints[static_cast<std::size_t>(joint)];
    for (const int axis : {0, 1}) {
      pack.set_limit(world, joint, axis, held.limits[static_cast<std::size_t>(axis)]);
      pack.set_motor(world, joint, axis, held.motors[static_cast<std::size_t>(axis)]);
    }
  }
}

void apply_settings_before(const model::Model& model, std::int64_t step, int world, Pack& pack) {
  for (const Event& event : model.events) {
    if (event.step < step) apply_setting(event, world, pack);
  }
}

}  // namespace pbmpi::solver
