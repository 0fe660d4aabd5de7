#include "simulation.h"

#include <gtest/gtest.h>

#include "ode/ode_stepper.h"

namespace pbmpi::ode {

namespace {

/// ODE's big-matrix solver already reports this for one box on a plane, whose 12 rows are redundant.
bool is_lcp_complaint(const std::string& line) {
  return line.find("LCP internal error") != std::string::npos;
}

WarningSink sink_for(stepping::StepperKind kind) {
  if (kind == stepping::StepperKind::quick) return fail_on_warning;
  return [](const std::string& line) {
    if (!is_lcp_complaint(line)) fail_on_warning(line);
  };
}

}  // namespace

void fail_on_warning(const std::string& line) { ADD_FAILURE() << line; }

Simulation::Simulation(const model::Model& model, const stepping::StepperSettings& settings)
    : OneWorld(model, make_ode_stepper(settings, sink_for(settings.kind))) {}

std::uint64_t hash_after(const model::Model& model, const stepping::StepperSettings& settings, int world,
                         int num_steps) {
  const auto stepper = make_ode_stepper(settings, sink_for(settings.kind));
  stepper->add(world, std::make_shared<model::Model>(model), model::initial_state(model), 0);
  core::PhaseTimes times;
  stepper->advance(num_steps, times);
  return model::hash(stepper->state(world));
}

}  // namespace pbmpi::ode
