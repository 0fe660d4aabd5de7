/// A mechanism that is ready to be put into Models.
#pragma once

#include <string>
#include <vector>

#include "scenes/links/contact_groups.h"
#include "scenes/links/joint_chain.h"

namespace pbmpi::scenes::links {

/// The place of a mechanism in a world.
struct Place {
  std::string name;              ///< prefix of the names of its bodies, joints and actors: "name.link"
  Pose pose;                     ///< of the mechanism's frame
  Vec3 velocity = Vec3::Zero();  ///< of all its bodies, world frame [m/s]
  int space = 0;                 ///< index into Model::spaces
};

class Assembly {
 public:
  /// Throws core::InputError where a body that moves has no mass, or two things of one kind have the same
  /// name. `notes` receives what pbmpi interprets differently; dt_s: the step, which limits how fast servos
  /// return.
  Assembly(const Mechanism& mechanism, double dt_s, xml::Notes& notes);

  /// Puts in the bodies of the links first, in the mechanism's order, then the bodies between joints of one
  /// link.
  void put_into(const Place& place, model::Model& model) const;

 private:
  class Builder;
  void note_chains(xml::Notes& notes) const;
  void take_closures(const Mechanism& mechanism, xml::Notes& notes);

  RigidTree tree_;
  std::vector<JointChain> chains_;  ///< [num_rigids]
  /// What connects two rigids besides the tree's joints, with frames in the mechanism's frame at the start.
  std::vector<Closure> closures_;
  ContactGroups groups_;
  std::vector<double> mu_of_group_;  ///< friction that all geoms of a group share
  double dt_s_;
};

}  // namespace pbmpi::scenes::links
