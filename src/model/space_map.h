/// How one world is cut into spaces, as plain tables.
#pragma once

#include <vector>

#include "model/model.h"

namespace pbmpi::model {

/// A unit is a set of bodies that joints connect. It lies in one space as a whole, since its bodies are
/// always solved together: in the space with most of its geoms (the lowest on a tie; the first if it has
/// none), whatever spaces the model gives to its individual geoms. Hence a joint never connects two spaces.
///
/// Static geoms belong to every space.
struct SpaceMap {
  std::vector<int> unit_of_body;                 ///< [num_bodies]
  std::vector<std::vector<int>> bodies_of_unit;  ///< [num_units] ascending
  std::vector<int> rows_of_unit;   ///< [num_units] rows of its joints, motors included, limits not
  std::vector<int> shape_of_unit;  ///< [num_units] equal for equal numbers of bodies, rows, joints
  std::vector<int> space_of_unit;  ///< [num_units]
  std::vector<std::vector<int>> units_of_space;  ///< [num_spaces] ascending
  std::vector<std::vector<int>> geoms_of_space;  ///< [num_spaces] ascending, geoms of bodies only

  int num_units() const { return static_cast<int>(bodies_of_unit.size()); }
  int num_shapes() const;
  int num_spaces() const { return static_cast<int>(units_of_space.size()); }
  int space_of_body(int body) const {
    return space_of_unit[static_cast<std::size_t>(unit_of_body[static_cast<std::size_t>(body)])];
  }
};

SpaceMap make_space_map(const Model& model);

}  // namespace pbmpi::model
