/// The interface through which several ranks, each of which owns some of its spaces, step one world, whatever
/// the engine.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/clock.h"
#include "effects/field_of_interest.h"
#include "effects/space_sleepers.h"
#include "geometry/box.h"
#include "model/contact.h"
#include "model/model.h"
#include "model/space_map.h"
#include "model/state.h"
#include "stepping/observables.h"
#include "stepping/step_contacts.h"

namespace pbmpi::stepping {

/// One rank's view of the world. It knows all bodies; the rows of state() that belong to its own spaces are
/// current, the others are as the rank last heard of them. The result of a step depends neither on who owns
/// what nor on where an island is solved.
///
/// A step is fire_events(), collide(), perhaps collide_across(), solve(). Units, spaces: model/space_map.h.
class SpaceStepper {
 public:
  virtual ~SpaceStepper() = default;

  virtual const model::Model& model() const = 0;
  virtual const model::SpaceMap& map() const = 0;
  virtual const model::State& state() const = 0;
  /// Null without the effect "sleeping". With it collide() and collide_across() find the contacts that have
  /// an awake body, and solve() moves the units that are awake.
  virtual effects::SpaceSleepers* sleepers() { return nullptr; }
  /// Null without the effect "field_of_interest". With it solve() sorts the islands that it is given, once
  /// the field has been told where the followed body is.
  virtual effects::FieldOfInterest* field() { return nullptr; }
  /// How many units of one shape are solved at the cost of one.
  virtual int num_lanes() const = 0;

  /// From now on these spaces (ascending) are this rank's own. `state`: that of all bodies at the start of
  /// step `step`.
  virtual void own(std::span<const int> spaces, const model::State& state, std::int64_t step) = 0;

  /// Takes in rows of state() that were computed elsewhere: for each body position, orientation, velocity and
  /// angular velocity, 13 numbers.
  virtual void put_states(std::span<const int> bodies, std::span<const double> rows) = 0;

  /// State::broken_in of the joints of these units, unit by unit, and the call that takes it in from
  /// elsewhere; empty without the effect "breakable_joints". The joints of units that this rank owns or
  /// solves are current.
  virtual std::vector<std::int32_t> broken_rows(std::span<const int> units) const {
    static_cast<void>(units);
    return {};
  }
  virtual void put_broken(std::span<const int> units, std::span<const std::int32_t> rows) {
    static_cast<void>(units);
    static_cast<void>(rows);
  }

  /// Does a step hand on forces to the next (State::memory)?
  virtual bool remembers() const { return false; }
  /// The memory of these units: the contacts whose body a is in one of them, and their joints; and the call
  /// that takes it in from elsewhere, replacing what was known of these units. The numbers are in the
  /// engine's own form. The forces of units that this rank owns or solves are current.
  virtual std::vector<double> memory_rows(std::span<const int> units) const {
    static_cast<void>(units);
    return {};
  }
  virtual void put_memory(std::span<const int> units, std::span<const double> rows) {
    static_cast<void>(units);
    static_cast<void>(rows);
  }

  /// Fires the events of this step: all settings of joints, and the launches of own bodies.
  virtual void fire_events(std::int64_t step) = 0;
  /// Fires the launches of the other bodies, for a rank that collides across: in a step once, however often
  /// it is called. Rows that are put in afterwards are those of bodies that their owner has launched.
  virtual void launch_others(std::int64_t step) = 0;
  /// Do rules of effects change velocities between two steps? launch_others() then applies them to all other
  /// bodies, whose states must be current.
  virtual bool has_velocity_rules() const { return false; }

  /// Finds the contacts between bodies of own spaces, and of these with static geoms, in canonical order
  /// (sorted by Contact::geoms). None if a pose is not finite: the world is lost, and colliders must not see
  /// it.
  virtual void collide(std::vector<model::Contact>& contacts) = 0;
  /// Boxes [spaces] that hold the geoms of these spaces (ascending) at the poses of state(), and wherever
  /// fast bodies may get in a step; they need not be tight.
  virtual std::vector<geometry::Box> space_boxes(std::span<const int> spaces) = 0;
  /// The spaces (ascending) whose box overlaps that of another owner's space; `owner`, `boxes`: [num_spaces].
  virtual std::vector<int> near_spaces(std::span<const int> owner, std::span<const geometry::Box> boxes) = 0;
  /// Finds the contacts between bodies of spaces that different ranks own, in canonical order, and what is
  /// ahead of fast bodies there. `owner`, `boxes`: as in near_spaces(), whose spaces alone must be current
  /// and are looked at.
  virtual void collide_across(std::span<const int> owner, std::span<const geometry::Box> boxes,
                              std::vector<model::Contact>& contacts) = 0;

  /// Moves the bodies of these units (ascending) by a step. `contacts`: all contacts and approaches of these
  /// bodies, in canonical order; both bodies of a contact belong to these units. Adds the seconds spent to
  /// rows, solve, integrate.
  virtual void solve(std::span<const int> units, std::span<const model::Contact> contacts, std::int64_t step,
                     core::PhaseTimes& times) = 0;
  /// The contacts, rows and islands of the last solve(), whose units are given again. The other observables
  /// are zero; join() of stepping/observable_table.h makes the world's from those of its ranks.
  virtual Observables count(std::span<const int> units) const = 0;
  virtual bool shows_contacts() const { return false; }  ///< StepperSettings::contacts
  /// With shows_contacts(): the contacts and forces with which the last solve() ended. The forces of joints
  /// outside these units, which are those of the solve(), are zero.
  virtual StepContacts contacts_of(std::span<const int> units) const {
    static_cast<void>(units);
    return {};
  }
};

}  // namespace pbmpi::stepping
