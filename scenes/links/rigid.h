/// Joins links that no joint separates into one rigid body.
#pragma once

#include <string>
#include <vector>

#include "scenes/links/links.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::links {

/// One body; the first one is everything fixed to the world.
struct Rigid {
  std::string name;
  std::string where;
  int parent = no_link;           ///< index of an earlier rigid; 0: the world
  Pose pose;                      ///< pose of its frame (that of its uppermost link) in the mechanism's frame
  std::vector<LinkJoint> joints;  ///< joints to the parent; only the world has none
  MassProperties mass{0, Vec3::Zero(), model::Mat3::Zero()};  ///< in the rigid's frame
  std::vector<LinkGeom> geoms;                                ///< in the rigid's frame
  std::string odd_inertia;                                    ///< of the first of its links that has one
};

struct RigidTree {
  std::vector<Rigid> rigids;  ///< [0] is the world
  std::vector<int> rigid_of;  ///< [num_links]
};

/// Joins links without joints to their parents. Throws core::InputError where bodies that move have no mass,
/// naming all of them; with Mechanism::joins_massless after join_massless() (massless.h), which `notes`
/// tells.
RigidTree merge(const Mechanism& mechanism, xml::Notes& notes);

/// The mass properties of two masses that are rigidly joined, in one frame.
MassProperties together(const MassProperties& a, const MassProperties& b);

/// The mass properties of a mass whose frame lies at `pose`, in the outer frame.
MassProperties moved(const MassProperties& mass, const Pose& pose);

}  // namespace pbmpi::scenes::links
