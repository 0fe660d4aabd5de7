/// Constraints between bodies in addition to the kinematic tree.
#pragma once

#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "model/model.h"
#include "mujoco/tree/joint_links.h"

namespace pbmpi::mujoco {

/// Pins a coordinate to a value while it is active: a limit without play, or a steered joint.
struct Pin {
  int joint = 0, axis = 0;  ///< of the model
  int body = 0;             ///< body whose link has the axis
  std::size_t k = 0;        ///< index into Link::axes
};

/// A point of a joint that closes a loop, or, with `welds`, the whole relative pose of its bodies.
struct Closure {
  int body_a = 0, body_b = model::no_body;
  model::Vec3 point_a = model::Vec3::Zero(), point_b = model::Vec3::Zero();  ///< [m] in the bodies' frames
  model::Pose b_in_a;                                                        ///< of a weld
  bool welds = false;
};

/// Pins, then closures, in the order of the compiled model.
struct Constraints {
  std::vector<Pin> pins;
  std::vector<Closure> closures;
};

/// Throws core::InputError, naming the joint, for a joint that closes a loop and is not a ball joint, hinge
/// or fixed joint, or that has a limit, a motor or a strength.
Constraints make_constraints(const model::Model& model, const JointTree& tree,
                             const std::vector<Link>& links);

/// Why the joint cannot close a loop; empty if it can.
std::string closing_problem(const model::Joint& joint, bool has_controls);

/// Makes closures hold the points of both bodies: MJCF can only express them at the start.
void place_closures(const Constraints& constraints, mjModel& compiled);

}  // namespace pbmpi::mujoco
