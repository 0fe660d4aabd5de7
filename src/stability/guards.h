/// The guards of one world of a run, and the limits at which they trip.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/model.h"
#include "model/state.h"
#include "stability/energy_gain.h"
#include "stability/passage.h"
#include "stepping/observable_table.h"
#include "stepping/run_event.h"

namespace pbmpi::stability {

/// Chosen so that no scene that comes with pbmpi trips them in its own frames at its default setting.
struct GuardLimits {
  /// A joint may open by this share of the size of its smaller body, which then fits into the gap. Hands and
  /// feet that a car hits open by half of their size for some steps.
  double gap_share = 1;
  /// Energy gained without a cause may reach this share of the largest kinetic energy so far: pushing out
  /// overlaps and closing gaps gains a little in each impact.
  double energy_share = 0.05;
  /// In addition, the work of lifting all bodies by this height [m] on Earth is allowed, which is what a
  /// world at rest with overlaps of this size may turn them into.
  double energy_lift_m = 0.01;
};

/// In the order of stepping::event_kind::guards.
enum class Guard { nonfinite, joint_gap, energy_gain, passage };

/// A guard that has tripped.
struct Trip {
  Guard guard = Guard::nonfinite;
  std::int64_t step = 0;             ///< counted from 0: the last step before the guard saw it
  int body = model::no_body;         ///< nonfinite, passage
  int joint = -1;                    ///< joint_gap
  int through = -1;                  ///< passage: geom
  std::string_view observable = {};  ///< nonfinite: the first that is not finite, where all bodies are
  double value = 0;                  ///< what the guard measured: stepping::event_kind
  double limit = 0;
};

/// A state, and the quantities that are measured of it anyway.
struct Seen {
  const model::State& state;
  double energy_j = 0;
  double joint_gap_m = 0;
  int nonfinite = 0;
  std::string_view not_finite;  ///< stepping::first_not_finite()

  Seen(const model::State& at, const stepping::Observables& observables)
      : state(at),
        energy_j(observables.energy_j),
        joint_gap_m(observables.joint_gap_m),
        nonfinite(observables.nonfinite),
        not_finite(stepping::first_not_finite(observables)) {}
};

/// Checks one world between two states, one or several steps apart. Work that costs more than a pass over the
/// bodies is done only where a defect is suspected.
class Guards {
 public:
  /// `model` is borrowed.
  Guards(const model::Model& model, double dt_s, const GuardLimits& limits = {});

  /// The states before and after the `num_steps` steps from `first_step` on.
  struct Span {
    Seen before, after;
    std::int64_t first_step = 0;
    int num_steps = 1;
  };
  /// The first guard that trips among: non-finite numbers (of bodies; of observables that were finite before,
  /// or in the first step), a joint that opens beyond its limit (and was
  /// within it before), energy gained without a cause, a passage. Gains of energy are summed in `memory`.
  /// `from` and `pace` are those of PassageFinder::find().
  std::optional<Trip> check(const Span& span, std::span<const model::Vec3> from, PassageFinder::Pace pace,
                            model::GuardMemory& memory) const;

  /// The positions of the bodies after the launches of these steps, if they are at `positions` before.
  std::span<const model::Vec3> launched(std::span<const model::Vec3> positions, std::int64_t first_step,
                                        int num_steps, std::vector<model::Vec3>& scratch) const;

  /// Updates memory.largest_kinetic_j with the kinetic energy of a state.
  void note_kinetic(const model::State& state, double energy_j, model::GuardMemory& memory) const;
  /// Limit [J] above which memory.energy_gain_j trips.
  double energy_limit(const model::GuardMemory& memory) const;
  const PassageFinder& passages() const { return passages_; }

 private:
  std::optional<Trip> check_gaps(const Span& span) const;

  const model::Model* model_;
  GuardLimits limits_;
  EnergyGain energy_;
  PassageFinder passages_;
  std::vector<double> gap_limit_;  ///< [num_joints] m
  double least_gap_limit_ = model::infinity;
  double lift_work_j_ = 0;
  std::vector<double> mass_kg_;  ///< [num_bodies] contiguous
};

/// The event for a guard that tripped in a world, for the run's file and summary.
stepping::RunEvent event_of(const Trip& trip, int world, const model::Model& model);

}  // namespace pbmpi::stability
