/// Turns the contact rules of a mechanism's geoms into actors of a Model.
#pragma once

#include <vector>

#include "scenes/links/rigid.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::links {

struct ContactGroup {
  bool is_static = false;       ///< does it have the world's geoms alone?
  bool self_collision = false;  ///< may geoms of its different bodies touch?
};

/// Geoms of different groups may touch.
struct ContactGroups {
  std::vector<ContactGroup> groups;
  std::vector<std::vector<int>> group_of;  ///< [num_rigids][num_geoms]
};

/// `apart`: pairs of rigids that never touch, in addition to the mechanism's pairs of links; `joined`: pairs
/// that do not touch because joints of the Model connect them. Geoms that must not touch share a group whose
/// geoms never touch each other: where this separates more geoms than required, a note says which. A geom
/// that touches no other geom has the group -1.
ContactGroups contact_groups(const Mechanism& mechanism, const RigidTree& tree,
                             const std::vector<std::pair<int, int>>& apart,
                             const std::vector<std::pair<int, int>>& joined, xml::Notes& notes);

}  // namespace pbmpi::scenes::links
