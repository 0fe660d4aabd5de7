/// The kinematic trees that the joints of a world form.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::mujoco {

/// What a body hangs on.
struct Hold {
  int joint = -1;               ///< to its parent; -1: it is free, the root of a tree
  int parent = model::no_body;  ///< no_body: the world, if there is a joint
};

/// A spanning forest of the joints that hold.
struct JointTree {
  std::vector<Hold> holds;   ///< [num_bodies]
  std::vector<int> order;    ///< bodies, each after its parent
  std::vector<int> closing;  ///< joints that close loops, ascending
};

/// Does the joint have anything but rows that it holds: a limit, a motor, an event that sets one, or a
/// strength?
std::vector<bool> joints_with_controls(const model::Model& model);

/// The tree is chosen so that what closes loops is, where possible, a ball joint, a hinge, or a fixed joint,
/// without limit, motor or strength; a free tree has its lowest body as root. `broken_in`: as in State; what
/// is broken is not there.
JointTree make_joint_tree(const model::Model& model, std::span<const std::int32_t> broken_in);

}  // namespace pbmpi::mujoco
