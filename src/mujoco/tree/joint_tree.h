/// The kinematic trees formed by the joints of a world.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::mujoco {

/// The attachment of a body.
struct Hold {
  int joint = -1;               ///< joint to its parent; -1: it is free, the root of a tree
  int parent = model::no_body;  ///< no_body: the world, if there is a joint
};

/// A spanning forest of the joints that hold.
struct JointTree {
  std::vector<Hold> holds;   ///< [num_bodies]
  std::vector<int> order;    ///< bodies, each after its parent
  std::vector<int> closing;  ///< joints that close loops, ascending
};

/// How MuJoCo closes a loop of joints.
enum class Closing {
  none,        ///< not at all
  weld,        ///< holds the pose of one body in the other
  two_points,  ///< holds two points of an axis
  point,       ///< holds one point
};

/// How a joint of this kind can close a loop.
Closing closing_of(model::JointKind kind);

/// Does the joint have more than its own rows: a limit, a motor, an event that sets one, or a strength?
std::vector<bool> joints_with_controls(const model::Model& model);

/// Builds the tree such that the joints that close loops are, where possible, ball joints, hinges or fixed
/// joints without limit, motor or strength; a free tree has its lowest body as root. `broken_in`: as in
/// State; broken joints are left out.
JointTree make_joint_tree(const model::Model& model, std::span<const std::int32_t> broken_in);

}  // namespace pbmpi::mujoco
