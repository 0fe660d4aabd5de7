/// The model's joints as Bullet's six-axis constraints, and their settings that change.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "bullet/objects/joint_frames.h"

namespace pbmpi::bullet {

/// One btGeneric6DofSpring2Constraint per joint, in the model's order: each of its axes, three linear and
/// three angular, is locked, free or limited. `axis`: 0 or 1, as in the model.
class AxisJoints {
 public:
  /// `model` and `bodies` are borrowed.
  AxisJoints(const model::Model& model, Bodies& bodies);

  int size() const { return static_cast<int>(joints_.size()); }
  btGeneric6DofSpring2Constraint& operator[](int joint) { return *joints_[static_cast<std::size_t>(joint)]; }

  /// To be called before a step, with the bodies in place: Bullet's rows of a sliding joint act on the first
  /// body at its joint frame, so the frame moves along with the second body. Without this a slider that turns
  /// gains energy, and its gap is the distance that it has slid times omega dt / ERP.
  void follow();
  void set_motor(int joint, int axis, const model::AxisMotor& motor);
  void set_limit(int joint, int axis, const model::AxisLimit& limit);
  /// Angle [rad] or length [m] of an axis for the present poses; to be called after follow(), so that its
  /// bits do not depend on the past.
  double coordinate(int joint, int axis);
  /// Scalar rows in a step from the present poses (Bullet's getInfo1): a limited axis has two, one per stop.
  int count_rows(int joint);

 private:
  /// A joint whose bodies move along its axis 1.
  struct Sliding {
    int joint = 0;
    btVector3 origin;        ///< [m] origin of its frame in the first body, as in the model
    btScalar way = 0;        ///< [m] displacement of the frame so far
    model::AxisLimit limit;  ///< [m] from `origin`
  };
  Sliding* find_sliding(int joint);
  void limit_sliding(const Sliding& sliding);

  const model::Model* model_;
  std::vector<Sliding> sliding_;  ///< ascending
  std::vector<std::unique_ptr<btGeneric6DofSpring2Constraint>> joints_;
};

}  // namespace pbmpi::bullet
