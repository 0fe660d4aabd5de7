/// Bodies between the model and Bullet.
#pragma once

#include <memory>
#include <vector>

#include "bullet/objects/engine.h"
#include "model/state.h"

namespace pbmpi::bullet {

/// One rigid body a model body, in the model's order, and the ground, which static geoms and joints to the
/// world belong to.
///
/// Bullet knows inertia along the axes of a body's frame only, so that its frame is the model's turned into
/// the principal axes. It keeps a rotation as matrix and the state as quaternion: settle() makes the matrix
/// of a body that has moved from the quaternion anew, so that a world that goes on has the bits of one that
/// starts from its state.
class Bodies {
 public:
  /// At the initial poses. `model` is borrowed.
  explicit Bodies(const model::Model& model);

  int size() const { return static_cast<int>(bodies_.size()); }
  btRigidBody& operator[](int body) { return *bodies_[static_cast<std::size_t>(body)]; }
  const btRigidBody& operator[](int body) const { return *bodies_[static_cast<std::size_t>(body)]; }
  btRigidBody& ground() { return *ground_; }
  /// The body, or the ground for no_body.
  btRigidBody& get(int body) { return body == model::no_body ? *ground_ : (*this)[body]; }

  /// A frame given in that of a model body [m], in the frame of Bullet's body.
  btTransform local(int body, const btTransform& in_model) const;
  /// A direction or vector given in the frame of a model body, in the world frame.
  model::Vec3 to_world(int body, const model::Vec3& local) const;

  /// Puts the bodies into `state` bit for bit.
  void restore(const model::State& state);
  void place(int body, const model::Vec3& position, const model::Quat& orientation);
  void set_velocity(int body, const model::Vec3& velocity, const model::Vec3& angular_velocity);
  /// After a step that moved these bodies.
  void settle(int body);
  /// Reads the bodies out. `state` has their number of rows.
  void copy_out(model::State& state) const;
  bool is_finite(int body) const;
  /// Awake bodies take part in a step; asleep they keep place.
  void show_awake(int body, bool awake);

 private:
  btTransform frame(int body, const model::Vec3& position, const model::Quat& orientation) const;

  std::unique_ptr<btCollisionShape> no_shape_;  ///< geoms are collided by themselves (Contacts)
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::unique_ptr<btRigidBody> ground_;
  std::vector<btQuaternion> principal_;   ///< [bodies] the principal axes in the model's frame
  std::vector<char> is_turned_;           ///< [bodies] are they other than that frame's own?
  std::vector<model::Quat> orientation_;  ///< [bodies] as the state has them
};

}  // namespace pbmpi::bullet
