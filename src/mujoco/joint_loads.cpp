#include "mujoco/joint_loads.h"

namespace pbmpi::mujoco {
namespace {

using model::Vec3;

Vec3 position_of(const Coordinates& at, const mjData& data, int body) {
  return Vec3(data.xpos + 3 * at.body_id(body));
}

/// The point about which the torque of a joint is taken [m], world frame.
Vec3 place_of(const model::Joint& joint, const Coordinates& at, const mjData& data) {
  const Vec3 a = position_of(at, data, joint.body_a);
  if (joint.kind == model::JointKind::slider)
    return joint.body_b == model::no_body ? a : Vec3(0.5 * (a + position_of(at, data, joint.body_b)));
  const mjtNum* q = data.xquat + 4 * at.body_id(joint.body_a);
  return a + Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * joint.anchor_a;
}

}  // namespace

JointLoads::JointLoads(const model::Model& model, const std::vector<Link>& links, const Coordinates& at)
    : model_(&model), links_(&links), at_(&at), forces_(model.joints.size()) {}

/// cfrc_int is the load of the parent on the child: torque about the centre of mass of the whole tree, then
/// force.
void JointLoads::measure(const mjModel& compiled, mjData& data) {
  mj_rnePostConstraint(&compiled, &data);
  for (int body = 0; body < static_cast<int>(links_->size()); ++body) {
    const int joint = (*links_)[body].hold.joint;
    if (joint < 0) continue;
    const model::Joint& held = model_->joints[joint];
    const int id = at_->body_id(body);
    const Vec3 torque(data.cfrc_int + 6 * id), force(data.cfrc_int + 6 * id + 3);
    const Vec3 centre(data.subtree_com + 3 * compiled.body_rootid[id]);
    const double sign = held.body_a == body ? 1 : -1;
    forces_[joint].force = sign * force;
    forces_[joint].torque = sign * (torque + (centre - place_of(held, *at_, data)).cross(force));
  }
}

}  // namespace pbmpi::mujoco
