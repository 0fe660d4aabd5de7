/// The passes of a pack's step.
#pragma once

#include <span>

#include "effects/effects.h"

namespace pbmpi::solver {

struct PackedWorld;

/// Which effects a step of `sor` has. A pass that a world does not call for changes no bit of its state, so
/// that the worlds of a pack share the passes of all.
struct Passes {
  bool collision = false;
  /// May a contact turn a body? False where nothing rubs and every body is a ball, since all normals go
  /// through the centres.
  bool turning_contacts = false;
  bool fast_bodies = false;
  bool restitution = false;
  bool gyroscopic_torque = false;
  bool gravity = false;
  bool damping = false;
  bool sleeping = false;
  bool field_of_interest = false;
  bool in_parts = false;  ///< do steps move some islands apart from others?
  /// Effects that are demanded though nothing calls for them: friction rows at mu = 0, rows at all joint axes
  /// that could have a limit or a motor, gyroscopic torque of spheres and cubes. Where an effect is called
  /// for, its rows follow from the contacts and joints one by one.
  bool idle_friction = false;
  bool idle_limits = false;
  bool idle_motors = false;
  bool idle_gyroscopic_torque = false;

  /// Are there steps of some bodies only, after which the others must be as before?
  bool holds_bodies() const { return sleeping || field_of_interest || in_parts; }
};

Passes passes_of(const model::Model& model);
/// The passes that any world of a pack has.
Passes shared_passes(std::span<const PackedWorld> worlds);

}  // namespace pbmpi::solver
