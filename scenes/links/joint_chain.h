/// Several joints of one link, as joints of a Model, each of which has two bodies of its own.
#pragma once

#include <string>
#include <vector>

#include "scenes/links/rigid.h"

namespace pbmpi::scenes::links {

/// One joint of a Model.
struct ChainPiece {
  model::JointKind kind = model::JointKind::hinge;
  /// Of the link, outermost first: two of a universal, else one.
  std::vector<LinkJoint> joints;
};

/// From a body's parent to the body: pieces.size() - 1 bodies stand between.
struct JointChain {
  std::vector<ChainPiece> pieces;       ///< the first at the parent
  std::vector<MassProperties> between;  ///< bodies in the link's frame
  MassProperties rest;                  ///< of the link itself
  /// All joints turn about one point: a ball joint between the parent and the body changes nothing, holds the
  /// load, and keeps the two from touching.
  bool is_gimbal = false;
};

/// Two hinges about one point with axes at right angles are a universal joint, and any one joint is itself:
/// these are exact. All else needs bodies between, which take a share of the link's mass. About one point the
/// whole still has the link's mass, centre of mass, and inertia about the point; what the bodies between add
/// is a rotor on the joints outside of them. Of sliding joints, and of hinges about several points, the share
/// stays where its body goes.
JointChain chain_of(const Rigid& rigid);

/// The share of a link's mass, and of its mean moment of inertia about the joints, that one body between has
/// at most: less makes solvers slower to converge, more is farther from the mechanism.
inline constexpr double share_between = 0.02;

}  // namespace pbmpi::scenes::links
