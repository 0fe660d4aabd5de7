/// A mechanism, ready to be put into Models.
#pragma once

#include <string>
#include <vector>

#include "scenes/links/contact_groups.h"
#include "scenes/links/joint_chain.h"

namespace pbmpi::scenes::links {

/// Where a mechanism of a world goes.
struct Place {
  std::string name;              ///< before those of its bodies, joints and actors: "name.link"
  Pose pose;                     ///< of the mechanism's frame
  Vec3 velocity = Vec3::Zero();  ///< of all its bodies, world frame [m/s]
  int space = 0;                 ///< index into Model::spaces
};

class Assembly {
 public:
  /// Throws core::InputError where a body that moves has no mass, or two things of one kind have one name.
  /// What pbmpi takes otherwise goes to `notes`; dt_s: the step, which bounds how fast servos return.
  Assembly(const Mechanism& mechanism, double dt_s, xml::Notes& notes);

  /// Bodies of the links first, in the mechanism's order, then those between joints of one link.
  void put_into(const Place& place, model::Model& model) const;

 private:
  class Builder;
  void note_chains(xml::Notes& notes) const;

  RigidTree tree_;
  std::vector<JointChain> chains_;  ///< [num_rigids]
  ContactGroups groups_;
  std::vector<double> mu_of_group_;  ///< friction; that of all its geoms
  double dt_s_;
};

}  // namespace pbmpi::scenes::links
