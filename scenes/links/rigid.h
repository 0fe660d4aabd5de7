/// Links that no joint moves against each other, as one rigid body.
#pragma once

#include <string>
#include <vector>

#include "scenes/links/links.h"

namespace pbmpi::scenes::links {

/// One body, or, as the first of all, what stands fast in the world.
struct Rigid {
  std::string name;
  std::string where;
  int parent = no_link;           ///< index of an earlier one; 0: the world
  Pose pose;                      ///< of its frame, that of its uppermost link, in the mechanism's frame
  std::vector<LinkJoint> joints;  ///< to the parent; none only of the world
  MassProperties mass{0, Vec3::Zero(), model::Mat3::Zero()};  ///< in its frame
  std::vector<LinkGeom> geoms;                                ///< in its frame
};

struct RigidTree {
  std::vector<Rigid> rigids;  ///< [0] is the world
  std::vector<int> rigid_of;  ///< [num_links]
};

/// Joins links without joints to those above them. Throws core::InputError where a body that moves has no
/// mass.
RigidTree merge(const Mechanism& mechanism);

/// Two masses, rigidly together, in one frame.
MassProperties together(const MassProperties& a, const MassProperties& b);

/// A mass whose frame lies at `pose`, in the outer frame.
MassProperties moved(const MassProperties& mass, const Pose& pose);

}  // namespace pbmpi::scenes::links
