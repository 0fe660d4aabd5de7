/// Converts bodies between the model and Bullet.
#pragma once

#include <memory>
#include <vector>

#include "bullet/objects/engine.h"
#include "model/state.h"

namespace pbmpi::bullet {

/// One rigid body per model body, in the model's order, and the ground, to which static geoms and joints to
/// the world belong.
///
/// Bullet supports inertia only along the axes of a body's frame, so its frame is the model's turned into the
/// principal axes. Bullet keeps a rotation as a matrix, the state keeps a quaternion: settle() recomputes the
/// matrix of a body that has moved from the quaternion, so that a world that continues has the same bits as
/// one that starts from its state.
class Bodies {
 public:
  /// Makes the bodies at their initial poses. `model` is borrowed.
  explicit Bodies(const model::Model& model);

  int size() const { return static_cast<int>(bodies_.size()); }
  btRigidBody& operator[](int body) { return *bodies_[static_cast<std::size_t>(body)]; }
  const btRigidBody& operator[](int body) const { return *bodies_[static_cast<std::size_t>(body)]; }
  btRigidBody& ground() { return *ground_; }
  /// The body, or the ground for no_body.
  btRigidBody& get(int body) { return body == model::no_body ? *ground_ : (*this)[body]; }

  /// Converts a frame given in that of a model body [m] to the frame of Bullet's body.
  btTransform local(int body, const btTransform& in_model) const;
  /// Converts a direction or vector given in the frame of a model body to the world frame.
  model::Vec3 to_world(int body, const model::Vec3& local) const;

  /// Puts the bodies into `state` bit for bit.
  void restore(const model::State& state);
  void place(int body, const model::Vec3& position, const model::Quat& orientation);
  void set_velocity(int body, const model::Vec3& velocity, const model::Vec3& angular_velocity);
  /// To be called after a step that moved these bodies.
  void settle(int body);
  /// Reads the bodies into `state`, which has as many rows.
  void copy_out(model::State& state) const;
  bool is_finite(int body) const;
  /// Awake bodies take part in a step; sleeping ones stay in place.
  void show_awake(int body, bool awake);

 private:
  btTransform frame(int body, const model::Vec3& position, const model::Quat& orientation) const;

  std::unique_ptr<btCollisionShape> no_shape_;  ///< of all bodies: Contacts collides their geoms
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::unique_ptr<btRigidBody> ground_;
  std::vector<btQuaternion> principal_;   ///< [bodies] the principal axes in the model's frame
  std::vector<char> is_turned_;           ///< [bodies] do the principal axes differ from that frame's own?
  std::vector<model::Quat> orientation_;  ///< [bodies] as in the state
};

}  // namespace pbmpi::bullet
