/// How often, and where, a scene places one [[actor]].
#pragma once

#include <vector>

#include "scenes/actors/variation.h"
#include "scenes/format/table_reader.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {

/// Copies of an actor: a row, rows of rows, or one copy at each of several places. Without copies there is
/// one actor, whose name has no number.
class Copies {
 public:
  Copies() = default;
  /// Reads `copies` and `spacing`, or `places`.
  explicit Copies(TableReader& actor);

  bool are_numbered() const { return numbered_; }
  int in(int world) const { return count_.in(world); }
  bool are_as_many_everywhere() const { return count_.is_constant(); }
  /// Offset of copy 0, 1, ... from the actor's position [m], world frame.
  Vec3 offset(int copy) const;

 private:
  void read_rows(TableReader& actor);
  void read_places(TableReader& actor);

  bool numbered_ = false;
  WorldCount count_;
  std::vector<int> row_lengths_;  ///< [rows of rows] innermost first; the last length is not used
  std::vector<Vec3> spacings_;    ///< [rows of rows] innermost first
  std::vector<Vec3> places_;      ///< used instead of rows, if not empty
};

}  // namespace pbmpi::scenes
