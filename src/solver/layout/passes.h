/// The passes of a pack's step.
#pragma once

#include <span>

#include "effects/effects.h"

namespace pbmpi::solver {

struct PackedWorld;

/// Which effects a step of `sor` has. A pass that a world does not call for changes no bit of its state, so
/// that all worlds of a pack go through the passes of any of them.
struct Passes {
  bool collision = false;
  /// May a contact turn a body? False without friction if every body is a ball, since all normals then go
  /// through the centres.
  bool turning_contacts = false;
  bool fast_bodies = false;
  bool restitution = false;
  bool gyroscopic_torque = false;
  bool gravity = false;
  bool damping = false;
  bool sleeping = false;
  bool field_of_interest = false;
  bool in_parts = false;  ///< do steps move some islands separately from others?
  /// Effects that are demanded though nothing calls for them: friction rows at mu = 0, rows at all joint axes
  /// that could have a limit or a motor, gyroscopic torque of spheres and cubes. Where something calls for an
  /// effect, its rows follow from the contacts and joints one by one.
  bool idle_friction = false;
  bool idle_limits = false;
  bool idle_motors = false;
  bool idle_gyroscopic_torque = false;

  /// Are there steps that move only some bodies, and must leave the others as they were?
  bool holds_bodies() const { return sleeping || field_of_interest || in_parts; }
};

Passes passes_of(const model::Model& model);
/// The passes that any world of a pack has.
Passes shared_passes(std::span<const PackedWorld> worlds);

}  // namespace pbmpi::solver
