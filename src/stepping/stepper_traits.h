/// What each kind of stepper can do.
#pragma once

#include <array>

#include "stepping/stepper.h"

namespace pbmpi::stepping {

struct StepperTraits {
  bool iterates = false;          ///< StepperSettings::iterations counts
  int own_iterations = 0;         ///< by default; 0: those of the scene, which are meant for quick and
                                  ///< for sor with ODE's laws
  bool has_field = false;         ///< gives islands outside of a field of interest fewer iterations
  bool has_laws = false;          ///< StepperSettings::law can be chosen
  bool has_substeps = false;      ///< can share one collision detection among parts of a step
  bool has_precision = false;     ///< can compute in another number type than double
  bool has_lanes = false;         ///< works in vector lanes: instructions can be chosen
  bool cuts_spaces = false;       ///< has a SpaceStepper: one world can be cut over ranks
  bool shows_residuals = false;   ///< measures Observables::residuals
  bool profiles_islands = false;  ///< WorldStepper::profile_last_step() measures single islands
  /// Time of a sweep (of a solve, for a stepper without sweeps) over that of sor: roughly, to deal out work.
  double relative_cost = 1;
};

/// In the order of StepperKind.
inline constexpr std::array<StepperTraits, 5> stepper_traits = {{
    {.iterates = true, .has_field = true, .profiles_islands = true, .relative_cost = 5},
    {.profiles_islands = true, .relative_cost = 5},
    {.iterates = true,
     .has_field = true,
     .has_laws = true,
     .has_substeps = true,
     .has_precision = true,
     .has_lanes = true,
     .cuts_spaces = true,
     .shows_residuals = true},
    {.iterates = true, .own_iterations = 10, .relative_cost = 8},   // Bullet's btContactSolverInfo
    {.iterates = true, .own_iterations = 100, .relative_cost = 1},  // mjOption::iterations; few are done
}};

constexpr const StepperTraits& traits_of(StepperKind kind) {
  return stepper_traits[static_cast<std::size_t>(kind)];
}

/// The iterations of a stepper in a scene that asks for `scene_iterations`: the scene counts QuickStep's
/// iterations, and other steppers have their own number.
constexpr int default_iterations(StepperKind kind, Law law, int scene_iterations) {
  if (traits_of(kind).has_laws && law == Law::soft) return StepperSettings{}.iterations;
  const int own = traits_of(kind).own_iterations;
  return own > 0 ? own : scene_iterations;
}

/// The settings with which a kind of stepper is meant to be used, and `sor` with each of its laws: the soft
/// one keeps most of scenes/hard stable at least cost (docs/stability.md).
constexpr StepperSettings default_settings(StepperKind kind, Law law = Law::soft) {
  constexpr int iterations_of_quick = 20;  // ODE's default, and the scenes'
  StepperSettings settings{.kind = kind, .iterations = default_iterations(kind, law, iterations_of_quick)};
  if (traits_of(kind).has_laws && law == Law::soft) return settings;
  settings.law = traits_of(kind).has_laws ? law_named(law) : ode_law();
  settings.substeps = 1;
  return settings;
}

}  // namespace pbmpi::stepping
