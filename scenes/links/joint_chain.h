/// Represents several joints of one link by joints of a Model, each of which connects two bodies of its own.
#pragma once

#include <string>
#include <vector>

#include "scenes/links/rigid.h"

namespace pbmpi::scenes::links {

/// One joint of a Model.
struct ChainPiece {
  model::JointKind kind = model::JointKind::hinge;
  /// The link's joints in this piece, outermost first: two for a universal, else one.
  std::vector<LinkJoint> joints;
};

/// The chain from a body's parent to the body, with pieces.size() - 1 bodies in between.
struct JointChain {
  std::vector<ChainPiece> pieces;       ///< the first one is at the parent
  std::vector<MassProperties> between;  ///< bodies in between, in the link's frame
  MassProperties rest;                  ///< the link itself
  /// All joints turn about one point: a ball joint between the parent and the body does not restrict the
  /// motion, carries the load, and keeps the two from touching.
  bool is_gimbal = false;
};

/// Two hinges about one point with perpendicular axes form a universal joint, and a single joint is kept:
/// both are exact. All other chains need bodies in between, which take a share of the link's mass. If all
/// joints share one point, the whole still has the link's mass, centre of mass, and inertia about the point;
/// the bodies in between add only a rotor to the joints outside of them. With sliding joints, and with hinges
/// about several points, the share stays where its body goes.
JointChain chain_of(const Rigid& rigid);

/// The largest share of a link's mass, and of its mean moment of inertia about the joints, that one body in
/// between takes: a smaller share makes solvers converge more slowly, a larger one departs further from the
/// mechanism.
inline constexpr double share_between = 0.02;

}  // namespace pbmpi::scenes::links
