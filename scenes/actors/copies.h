/// How often a scene places one [[actor]], and where.
#pragma once

#include <vector>

#include "scenes/actors/variation.h"
#include "scenes/format/table_reader.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {

/// Copies of an actor: a row, rows of rows, or one at each of several places. Without any there is one actor,
/// whose name has no number.
class Copies {
 public:
  Copies() = default;
  /// Reads `copies` and `spacing`, or `places`.
  explicit Copies(TableReader& actor);

  bool are_numbered() const { return numbered_; }
  int in(int world) const { return count_.in(world); }
  bool are_as_many_everywhere() const { return count_.is_constant(); }
  /// Where copy 0, 1, ... stands against the actor's position [m], world frame.
  Vec3 offset(int copy) const;

 private:
  void read_rows(TableReader& actor);
  void read_places(TableReader& actor);

  bool numbered_ = false;
  WorldCount count_;
  std::vector<int> row_lengths_;  ///< [rows of rows], the innermost first; the last is not asked for
  std::vector<Vec3> spacings_;    ///< likewise
  std::vector<Vec3> places_;      ///< instead of these
};

}  // namespace pbmpi::scenes
