/// Which geoms of a mechanism may touch, as actors of a Model.
#pragma once

#include <vector>

#include "scenes/links/rigid.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::links {

struct ContactGroup {
  bool is_static = false;       ///< has it the world's geoms alone?
  bool self_collision = false;  ///< may geoms of different bodies of it touch?
};

/// Geoms of different groups may touch.
struct ContactGroups {
  std::vector<ContactGroup> groups;
  std::vector<std::vector<int>> group_of;  ///< [num_rigids][num_geoms]
};

/// `apart`: pairs of rigids that never touch; `joined`: pairs that do not because joints of the Model connect
/// them. Geoms that must not touch share a group in which none touch: where that parts more of them than
/// asked for, a note says which. A geom that meets no other at all has the group -1.
ContactGroups contact_groups(const Mechanism& mechanism, const RigidTree& tree,
                             const std::vector<std::pair<int, int>>& apart,
                             const std::vector<std::pair<int, int>>& joined, xml::Notes& notes);

}  // namespace pbmpi::scenes::links
