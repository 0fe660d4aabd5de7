/// What the files of runs and studies say about scenes and the engines that step them.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "stepping/stepper.h"

namespace pbmpi::app {

/// The parameter under which a file keeps a scene's text: "scene_text_NAME", without a slash, which would
/// open a group.
inline std::string scene_text_parameter(std::string scene_name) {
  std::ranges::replace(scene_name, '/', '.');
  return "scene_text_" + scene_name;
}

/// The stepper's vector instructions and lanes, e.g. "avx512, 16 lanes"; empty for a stepper without a choice
/// of instructions.
std::string simd_text(const stepping::StepperSettings& settings);

/// ODE's version, with its precision if that is single.
std::string ode_text();

/// Name and version of the engine behind bullet or mujoco, e.g. "library_bullet" and "3.24, double
/// precision"; nothing for the other steppers.
std::optional<std::pair<std::string, std::string>> optional_engine_text(stepping::StepperKind kind);

/// Names and versions of all engines of this build, as above.
std::vector<std::pair<std::string, std::string>> engine_versions();

}  // namespace pbmpi::app
