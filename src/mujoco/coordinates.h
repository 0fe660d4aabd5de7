/// Converts between a world's state, which has a pose and a velocity of each body, and MuJoCo's joint
/// coordinates.
#pragma once

#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "model/model.h"
#include "model/state.h"
#include "mujoco/tree/joint_links.h"

namespace pbmpi::mujoco {

class Coordinates {
 public:
  /// `links` is borrowed.
  Coordinates(const std::vector<Link>& links, const mjModel& compiled);

  /// Sets qpos and qvel from the poses and velocities of `state`. Motion that the joints do not allow is
  /// dropped: a child then has another pose relative to its parent. Angles are within half a turn.
  void to_mujoco(const model::State& state, mjData& data) const;
  /// Sets the bodies' poses and velocities from qpos and qvel, for which it recomputes MuJoCo's own.
  void to_state(const mjModel& compiled, mjData& data, model::State& state) const;

  /// MuJoCo's number for a body.
  int body_id(int body) const { return body == model::no_body ? 0 : ids_[body]; }
  /// The body with this number in MuJoCo.
  int body_of(int id) const { return bodies_[id]; }
  /// MuJoCo's number of the first axis of a body's link.
  int first_axis(int body) const { return first_axis_[body]; }

 private:
  const std::vector<Link>* links_;
  std::vector<int> ids_;          ///< [num_bodies]
  std::vector<int> bodies_;       ///< [MuJoCo's bodies] no_body for the world
  std::vector<int> first_axis_;   ///< [num_bodies]
  std::vector<int> qpos_, qvel_;  ///< [num_bodies] first index of its coordinates and speeds
};

}  // namespace pbmpi::mujoco
