/// Joints from the model, and their settings that change: motors and limits.
#pragma once

#include <vector>

#include "model/model.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// One ODE joint a model joint, in the model's order. The bodies must stand at their initial poses (ODE takes
/// the relative pose of a joint from them) and are there again afterwards. Throws core::InputError for a
/// joint that ODE does not have: a motor or limit on an axis that the kind lacks, a hinge2 to the world.
std::vector<dJointID> make_joints(dWorldID world, const std::vector<dBodyID>& bodies,
                                  const model::Model& model, double dt_s);

/// `axis`: 0 or 1.
void set_motor(dJointID joint, model::JointKind kind, int axis, const model::AxisMotor& motor);
/// Aims a motor with a hold rate at the initial pose for the next step of `dt_s`.
void aim_motor(dJointID joint, model::JointKind kind, int axis, const model::AxisMotor& motor, double dt_s);
void set_limit(dJointID joint, model::JointKind kind, int axis, const model::AxisLimit& limit);

/// The scalar rows that the joint has in a step from the present poses: the degrees of freedom that its kind
/// removes, and one for each axis that stands at a limit or has a motor (ODE's getInfo1).
int count_rows(dJointID joint, model::JointKind kind);

}  // namespace pbmpi::ode
