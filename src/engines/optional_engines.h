/// The engines that a build may lack: Bullet and MuJoCo.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.h"
#include "stepping/stepper.h"

namespace pbmpi::engines {

/// An engine with a stepper of its own.
struct OptionalEngine {
  stepping::StepperKind stepper = stepping::StepperKind::bullet;
  std::string_view name;          ///< "Bullet"
  std::string_view package;       ///< Debian's package to build with
  std::string_view cmake_option;  ///< option that includes it or leaves it out
  std::string_view version;       ///< empty: not in this build

  bool in_build() const { return !version.empty(); }
};

std::span<const OptionalEngine> optional_engines();
/// The engine of this stepper; null for quick, direct and sor, which every build has.
const OptionalEngine* find_optional_engine(stepping::StepperKind kind);

/// Why this engine cannot step in a build without it, and what to do about that.
std::string absence_text(const OptionalEngine& engine);
/// Throws core::InputError, whose message begins with `where` (e.g. "--stepper bullet"), if this build lacks
/// the stepper's engine.
void require_in_build(stepping::StepperKind kind, const std::string& where);

/// "bullet (Bullet 3.24); not in this build: mujoco (Debian: libmujoco-dev)"
std::string builds_text();

/// Why the stepper refuses this model, one reason per line; empty if it takes it.
std::vector<std::string> refusals(stepping::StepperKind kind, const model::Model& model);

/// The features of this model that the stepper cannot express, or expresses differently from ODE, one per
/// line.
std::vector<std::string> inexpressible(stepping::StepperKind kind, const model::Model& model);

}  // namespace pbmpi::engines
