/// What a run does with a world whose guards trip.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string_view>

#include "stability/guards.h"
#include "stepping/stepper.h"

namespace pbmpi::stability {

enum class OnBlowup {
  report,  ///< the run goes on
  stop,    ///< the run ends after the frame
  freeze,  ///< the world stands still from the start of that step on
  refine   ///< the step is done again with finer ones; if 16 do not help, the world stands still
};
inline constexpr std::array<std::string_view, 4> on_blowup_names = {"report", "stop", "freeze", "refine"};

/// Does this setting replace states?
constexpr bool mends(OnBlowup on_blowup) {
  return on_blowup == OnBlowup::freeze || on_blowup == OnBlowup::refine;
}

using MakeStepper =
    std::function<std::unique_ptr<stepping::WorldStepper>(const stepping::StepperSettings& settings)>;

struct GuardSettings {
  OnBlowup on_blowup = OnBlowup::report;
  stepping::StepperSettings stepper;  ///< of the run
  MakeStepper make_stepper;           ///< makes the stepper of a world that is stepped again by itself
  GuardLimits limits;
};

}  // namespace pbmpi::stability
