#include "solver/joints/joint_load.h"

namespace pbmpi::solver {

using model::Vec3;

effects::Reaction reaction_of(const JointLoad& load, const model::Model& model, const model::Joint& joint,
                              const model::BodyPose& first, double h) {
  const model::HeldPlace place = model::traits_of(joint.kind).place;
  const Vec3 impulse(load.impulse);
  Vec3 turn(load.turn);
  if (place == model::HeldPlace::offset && joint.break_torque > 0) {
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(first.rotation);
    const Vec3 acts_at = effects::offset_of_second(model, joint);
    turn += (rotation * (acts_at - joint.anchor_a)).cross(impulse);
  }
  return {impulse.norm() / h, turn.norm() / h};
}

}  // namespace pbmpi::solver
