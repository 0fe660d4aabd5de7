/// What is measured of a world each frame. observable_table.h lists the columns that follow from it.
#pragma once

#include <array>

#include "model/joint_gap.h"
#include "model/mechanics.h"
#include "model/model.h"
#include "model/state.h"

namespace pbmpi::stepping {

/// How far the impulses and velocities of a step are from the solution of its constraint system. Each is the
/// largest over the rows of a world, which does not depend on the order of summation. With w = J v + cfm p -
/// rhs of a row with impulse p in [low, high], the natural map is the change of velocity that a projected
/// step along w still asks for: |p - clamp(p - w / d, low, high)| d, d being the row's diagonal; |w| where
/// nothing bounds p. Where friction is a cone a disc bounds its two rows; a ball bounds the rows of a patch,
/// with the twist divided by a length.
struct Residuals {
  double joint_speed = 0;        ///< [m/s] |w| of the joints' unbounded rows along lines
  double joint_turn = 0;         ///< [rad/s] |w| of the joints' unbounded rows about axes
  double complementarity_j = 0;  ///< [J] |p w| of the contacts' normal rows
  double natural_speed = 0;      ///< [m/s] natural map of all rows along lines: joints and contacts
  double natural_turn = 0;       ///< [rad/s] natural map of all rows about axes
};

/// Numbers of the last step of a frame, except where it says otherwise. With the effect "sleeping", contacts,
/// rows and penetration cover awake bodies only; islands cover all bodies.
struct Observables {
  int contacts = 0;  ///< contact points
  int rows = 0;      ///< scalar constraint rows of joints and contacts, three for a contact with friction
  int islands = 0;   ///< sets of connected bodies
  int max_island_rows = 0;  ///< rows of the island with the most
  int fast_bodies = 0;      ///< bodies that armed the effect fast_bodies; 0 without it
  int bodies_inside = 0;    ///< awake bodies in the field of interest; 0 without that effect
  double row_visits = 0;    ///< sum over rows of their sweeps; for a solver without sweeps the number of rows
  double energy_j = 0;      ///< kinetic + potential (height above z = 0 against gravity)
  double max_penetration_m = 0;  ///< deepest contact
  double joint_gap_m = 0;  ///< largest distance between the two anchors of an unbroken joint, after the step
  int nonfinite = 0;       ///< bodies with a NaN or an infinity
  std::array<double, 3> linear_momentum{};   ///< [kg m/s] of all bodies
  std::array<double, 3> angular_momentum{};  ///< [kg m^2/s] of all bodies, about the world's origin
  Residuals residuals;                       ///< all 0 unless they are asked for (StepperSettings::residuals)
};

/// Measures what follows from the states of one model alone, for any engine.
class StateObserver {
 public:
  explicit StateObserver(const model::Model& model) : mechanics_(model), gaps_(model) {}
  /// Fills in all of observe_bodies(), energy and joint gap.
  void observe(const model::State& state, Observables& seen) const;

 private:
  model::MechanicsMeter mechanics_;
  model::JointGaps gaps_;
};

/// StateObserver::observe() of a single state.
void observe_state(const model::Model& model, const model::State& state, Observables& seen);

/// Momenta and non-finite bodies of a single state. Where a world is cut into spaces root measures these,
/// while the spaces' owners share energy and joint gap.
void observe_bodies(const model::Model& model, const model::State& state, Observables& seen);

}  // namespace pbmpi::stepping
