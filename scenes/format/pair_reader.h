/// Materials of pairs of actors.
#pragma once

#include <array>
#include <string>

#include "scenes/format/table_reader.h"
#include "scenes/parts/growing_model.h"

namespace pbmpi::scenes {

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

}  // namespace pbmpi::scenes
