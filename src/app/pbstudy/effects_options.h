/// The command line of "pbstudy effects".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/common/options.h"
#include "app/pbstudy/study_scene.h"
#include "model/stepper.h"

namespace pbmpi::app {

struct EffectsOptions {
  bool help = false;
  std::vector<std::string> scenes;
  std::vector<std::string> effects;  ///< of the registry, in its order
  std::vector<model::StepperKind> steppers;
  std::vector<model::Precision> precisions;  ///< sor
  std::optional<int> iterations;             ///< else the scene's
  SceneOverrides overrides;
  int repeats = 15;     ///< times that each frame is timed with and without the effect
  int floor_seeds = 4;  ///< other solver seeds
  std::uint64_t seed = 1;
  std::optional<std::string> instructions_from;  ///< a file of the same cases, counted
  std::string output = "effects.h5";
  CommonOptions common;
  std::string command_line;
};

/// Throws core::InputError with one clear message.
EffectsOptions parse_effects_options(const std::vector<std::string>& args);

std::string effects_help_text();

}  // namespace pbmpi::app
