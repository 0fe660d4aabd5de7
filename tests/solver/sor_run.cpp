#include "solver/sor_run.h"

#include "ode/collide/narrow_phase.h"
#include "solver/pack/simd.h"
#include "solver/worlds/sor_stepper.h"

namespace pbmpi::solver {

std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings) {
  return make_sor_stepper(settings, ode::make_narrow_phase);
}

std::unique_ptr<stepping::WorldStepper> make_stepper(const stepping::StepperSettings& settings,
                                                     const std::vector<model::Model>& worlds) {
  auto stepper = make_stepper(settings);
  for (std::size_t i = 0; i < worlds.size(); ++i) {
    stepper->add(static_cast<int>(i), std::make_shared<const model::Model>(worlds[i]),
                 model::initial_state(worlds[i]), 0);
  }
  return stepper;
}

void advance(stepping::WorldStepper& stepper, int num_steps) {
  core::PhaseTimes times;
  stepper.advance(num_steps, times);
}

std::vector<stepping::Simd> machine_simds() {
  std::vector<stepping::Simd> simds;
  for (const stepping::Simd simd :
       {stepping::Simd::off, stepping::Simd::sse2, stepping::Simd::avx2, stepping::Simd::avx512}) {
    if (has_simd(simd)) simds.push_back(simd);
  }
  return simds;
}

}  // namespace pbmpi::solver
