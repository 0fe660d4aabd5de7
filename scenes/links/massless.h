/// Links that move but have no mass.
#pragma once

#include "scenes/links/rigid.h"

namespace pbmpi::scenes::links {

/// Takes out rigids without mass that touch nothing, where that changes the motion of no other: one without a
/// rigid below becomes part of its parent, and the joints of one with a single rigid below become that one's
/// first joints. Tells of both in `notes`.
void join_massless(RigidTree& tree, xml::Notes& notes);

}  // namespace pbmpi::scenes::links
