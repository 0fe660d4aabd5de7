/// Initial velocities of single parts of an actor.
#pragma once

#include <string>
#include <vector>

#include "scenes/format/table_reader.h"
#include "scenes/parts/growing_model.h"

namespace pbmpi::scenes {

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

}  // namespace pbmpi::scenes
