/// Makes joints from the model, and changes their settings: motors and limits.
#pragma once

#include <vector>

#include "model/model.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// One ODE joint per model joint, in the model's order. The bodies must be at their initial poses (from which
/// ODE takes a joint's relative pose) and are there again afterwards.
std::vector<dJointID> make_joints(dWorldID world, const std::vector<dBodyID>& bodies,
                                  const model::Model& model, double dt_s);

/// `axis`: 0 or 1.
void set_motor(dJointID joint, model::JointKind kind, int axis, const model::AxisMotor& motor);
/// Angle [rad] or length [m] of an axis for the present poses.
double coordinate(dJointID joint, model::JointKind kind, int axis);
void set_limit(dJointID joint, model::JointKind kind, int axis, const model::AxisLimit& limit);

/// The scalar rows of the joint in a step from the present poses: the degrees of freedom that its kind
/// removes, and one for each axis that is at a limit or has a motor (ODE's getInfo1).
int count_rows(dJointID joint, model::JointKind kind);

}  // namespace pbmpi::ode
