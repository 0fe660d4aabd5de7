/// What sor takes from a run's settings and a model's events, for whole worlds and spaces alike.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "model/contact.h"
#include "solver/pack/pack.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Throws core::InputError for dt <= 0, iterations or substeps < 1, a warm start outside 0 to 1, Newton's
/// method over rows that are not rigid, or an instruction set that this machine or build lacks.
void require_valid(const stepping::StepperSettings& settings);

/// Do the steps of a run start from the forces that the last one ended with?
inline bool remembers(const stepping::StepperSettings& settings) { return settings.law.warm_start > 0; }

/// Do quiet islands get fewer substeps than others (quiet_islands.h)?
inline bool spares_substeps(const stepping::StepperSettings& settings) {
  return settings.tolerance_m > 0 && settings.substeps > 1;
}

/// May islands get more substeps than others (tall_islands.h)? Only with a warm start are stiffer springs of
/// use.
inline bool adds_substeps(const stepping::StepperSettings& settings) {
  return settings.law.most_substeps > settings.substeps && remembers(settings);
}

/// [m] By how much bodies may approach each other in a step that is not cut into pieces; infinite where none
/// is: also without memory, since a piece starts with the forces of the one before.
double most_approach_m(const stepping::StepperSettings& settings);

/// Completes the memory of a state with which a world starts for the steps of a run: zero forces where none
/// are known, or no memory at all.
void start_memory(bool remembers, const model::Model& model, model::StepMemory& memory);

/// [m] The gap up to which the lanes are to find contacts in a world: PackedWorld::contact_margin_m.
double contact_margin_m(const stepping::StepperSettings& settings, const model::Model& model);

/// Collides the pairs of a world that the lanes do not: those of hulls, and those that `make_other` is for.
std::unique_ptr<model::NarrowPhase> make_fallback(const stepping::StepperSettings& settings,
                                                  const model::Model& model,
                                                  const model::MakeNarrowPhase& make_other);

/// The springs of a run's contacts, and of its joints' rows that hold a place and an orientation.
Spring contact_spring(const stepping::StepperSettings& settings);
Spring joint_place_spring(const stepping::StepperSettings& settings);
Spring joint_turn_spring(const stepping::StepperSettings& settings);

/// The parameters of a step of a run.
StepParameters step_parameters(const stepping::StepperSettings& settings, std::int64_t step);

/// Puts the joint setting of an event into the pack; a launch has none.
void apply_setting(const model::Event& event, int world, Pack& pack);

/// A launch at the body's current pose with its velocities in `state`, which Pack::launch() rounds and
/// places.
model::Event velocity_event(int body, const model::State& state);

/// Puts the model's initial motors and limits into the pack.
void apply_first_settings(const model::Model& model, int world, Pack& pack);

/// Puts the joint settings of all steps before this one into the pack.
void apply_settings_before(const model::Model& model, std::int64_t step, int world, Pack& pack);

}  // namespace pbmpi::solver
