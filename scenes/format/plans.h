/// What a scene file plans for the models of its worlds: events, materials of pairs, the field of interest,
/// and velocities of parts.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "scenes/format/table_reader.h"
#include "scenes/parts/growing_model.h"

namespace pbmpi::scenes {

/// Initial velocities of single parts of an actor.
class PartVelocities {
 public:
  PartVelocities() = default;
  /// Reads the actor's `parts`, a table of tables: `parts = { head = { velocity = [0, 0, 1] } }`.
  explicit PartVelocities(TableReader& actor);

  /// Gives the velocities to the parts of the actor called `actor`, one of the copies. Throws
  /// core::InputError at a part that the actor does not have.
  void put_into(GrowingModel& model, const std::string& actor) const;

 private:
  struct Part {
    std::string name;
    std::string where;
    core::Vec3 velocity, angular_velocity;
  };
  std::vector<Part> parts_;
};

/// A [[pair]] of the file (scenes/FORMAT.md): two actors, or all copies of one, and the material of their
/// contacts.
class PairPlan {
 public:
  explicit PairPlan(TableReader& table);

  /// Puts the pair into a model that has all its actors, replacing what an earlier [[pair]] set. Throws
  /// core::InputError at a name that no actor has.
  void put_into(GrowingModel& model) const;

 private:
  std::array<std::string, 2> actors_;
  std::string where_;
  model::Material material_;
};

/// The scene's [interest]: where the effect "field_of_interest" wants all iterations.
class InterestPlan {
 public:
  explicit InterestPlan(TableReader& table);

  /// Puts the field of interest into a model that has all its actors. Throws core::InputError at the name if
  /// no actor has that name, or if that actor has no body.
  void put_into(GrowingModel& model) const;

 private:
  int followed_body(GrowingModel& model) const;

  model::Interest interest_;
  std::string follows_;  ///< an actor; empty: the center is fixed
  std::string where_;    ///< place of its name in the file, and "interest"
};

/// Adds an event to a model that has all its bodies and joints. Throws core::InputError if the event names
/// one that does not exist.
using EventPlan = std::function<void(GrowingModel&)>;

/// Reads an [[event]] table (scenes/FORMAT.md); its time becomes the nearest step of `dt_s`.
EventPlan read_event(TableReader& table, double dt_s);

}  // namespace pbmpi::scenes
