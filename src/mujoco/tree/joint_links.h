/// How a body is attached to its parent, in MuJoCo's terms.
#pragma once

#include <vector>

#include "model/model.h"
#include "mujoco/tree/joint_tree.h"

namespace pbmpi::mujoco {

enum class Freedom { slide, hinge, ball };

/// A joint in MuJoCo's sense: one coordinate, or a ball's quaternion.
struct LinkAxis {
  Freedom freedom = Freedom::hinge;
  /// Unit, in the child's frame where all coordinates are zero. Its sign makes the coordinate that of the
  /// model: the joint's first body relative to its second.
  model::Vec3 direction = model::Vec3::UnitZ();
  int axis = 0;                ///< of the model's joint: 0 or 1
  bool is_suspension = false;  ///< the spring of a hinge2, which has no axis of its own
};

/// The pose of a child in its parent's frame (the world's if it has none), and how the child can move. MuJoCo
/// applies the axes from the parent to the child, so the first is fixed in the parent, the last in the child.
struct Link {
  Hold hold;
  model::Pose zero;  ///< pose of the child in the parent where all coordinates are zero
  bool has_anchor = false;
  model::Vec3 anchor_parent = model::Vec3::Zero();  ///< [m] in the parent's frame
  model::Vec3 anchor_child = model::Vec3::Zero();   ///< [m] in the child's frame
  std::vector<LinkAxis> axes;                       ///< none for a free or a fixed body

  bool is_free() const { return hold.joint < 0; }
};

/// The initial pose of a body or of the world.
inline model::Pose start_of(const model::Model& model, int body) {
  return body == model::no_body ? model::Pose{} : model.bodies[body].pose;
}

/// The pose of an inner frame in an outer one, where both are given in the world.
model::Pose relative(const model::Pose& outer, const model::Pose& inner);

int degrees_of_freedom(const std::vector<Link>& links);

/// [num_bodies] Where the anchors of a joint are apart at the start, the child is moved so that they meet.
std::vector<Link> make_links(const model::Model& model, const JointTree& tree);

}  // namespace pbmpi::mujoco
