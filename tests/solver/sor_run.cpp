#include "solver/sor_run.h"

#include "ode/narrow_phase.h"
#include "solver/simd.h"
#include "solver/sor_stepper.h"

namespace pbmpi::solver {

std::unique_ptr<model::WorldStepper> make_stepper(const model::StepperSettings& settings) {
  return make_sor_stepper(settings, ode::make_narrow_phase);
}

std::unique_ptr<model::WorldStepper> make_stepper(const model::StepperSettings& settings,
                                                  const std::vector<model::Model>& worlds) {
  auto stepper = make_stepper(settings);
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    stepper->add(static_cast<int>(i), std::make_shared<const model::Model>(worlds[i]),
                 model::initial_state(worlds[i]), 0);
  }
  return stepper;
}

void advance(model::WorldStepper& stepper, int num_steps) {
  core::PhaseTimes times;
  stepper.advance(num_steps, times);
}

std::vector<model::Simd> machine_simds() {
  std::vector<model::Simd> simds;
  for (const model::Simd simd :
       {model::Simd::off, model::Simd::sse2, model::Simd::avx2, model::Simd::avx512}) {
    if (has_simd(simd)) simds.push_back(simd);
  }
  return simds;
}

}  // namespace pbmpi::solver
