#include "ode/objects/joints.h"

#include <array>
#include <numbers>

#include "core/error.h"
#include "model/joint_traits.h"

namespace pbmpi::ode {
namespace {

using model::JointKind;
using model::Vec3;

constexpr double least_sine_between_axes = 0.1;  // 6 degrees; the cross product is the constrained direction

/// ODE's functions for one kind of joint. A null entry: the kind does not have this feature.
struct KindApi {
  dJointID (*create)(dWorldID, dJointGroupID);
  void (*set_anchor)(dJointID, dReal, dReal, dReal);
  void (*set_axes)(dJointID, const Vec3& axis1, const Vec3& axis2);
  void (*set_param)(dJointID, int, dReal);
  dReal (*get_param)(dJointID, int);
  std::array<dReal (*)(dJointID), 2> coordinate;  ///< angle or length along the axis, if it can have a limit
};

template <void (*set)(dJointID, dReal, dReal, dReal)>
void set_axis1(dJointID joint, const Vec3& axis1, const Vec3&) {
  set(joint, axis1.x(), axis1.y(), axis1.z());
}

/// ODE takes the axes one by one and requires that they are never parallel, so axis 1 first moves away from
/// both the old and the new direction of axis 2.
void set_universal_axes(dJointID joint, const Vec3& axis1, const Vec3& axis2) {
  dVector3 now;
  dJointGetUniversalAxis2(joint, now);
  const Vec3 normal = axis1.cross(axis2).normalized();
  const bool clear = normal.cross(vec3(now)).norm() > 0.1;
  const Vec3 detour = clear ? normal : Vec3((normal + axis1.cross(normal)).normalized());
  dJointSetUniversalAxis1(joint, detour.x(), detour.y(), detour.z());
  dJointSetUniversalAxis2(joint, axis2.x(), axis2.y(), axis2.z());
  dJointSetUniversalAxis1(joint, axis1.x(), axis1.y(), axis1.z());
}

void set_hinge2_axes(dJointID joint, const Vec3& axis1, const Vec3& axis2) {
  const dVector3 first = {real(axis1.x()), real(axis1.y()), real(axis1.z()), 0};
  const dVector3 second = {real(axis2.x()), real(axis2.y()), real(axis2.z()), 0};
  dJointSetHinge2Axes(joint, first, second);
}

void set_fixed(dJointID joint, const Vec3&, const Vec3&) { dJointSetFixed(joint); }

/// Indexed by JointKind.
constexpr std::array<KindApi, model::num_joint_kinds> kind_apis = {{
    {dJointCreateBall, dJointSetBallAnchor, nullptr, nullptr, nullptr, {}},
    {dJointCreateHinge,
     dJointSetHingeAnchor,
     set_axis1<dJointSetHingeAxis>,
     dJointSetHingeParam,
     dJointGetHingeParam,
     {dJointGetHingeAngle}},
    {dJointCreateSlider,
     nullptr,
     set_axis1<dJointSetSliderAxis>,
     dJointSetSliderParam,
     dJointGetSliderParam,
     {dJointGetSliderPosition}},
    {dJointCreateUniversal,
     dJointSetUniversalAnchor,
     set_universal_axes,
     dJointSetUniversalParam,
     dJointGetUniversalParam,
     {dJointGetUniversalAngle1, dJointGetUniversalAngle2}},
    {dJointCreateFixed, nullptr, set_fixed, nullptr, nullptr, {}},
    {dJointCreateHinge2,
     dJointSetHinge2Anchor,
     set_hinge2_axes,
     dJointSetHinge2Param,
     dJointGetHinge2Param,
     {dJointGetHinge2Angle1}},
}};

const KindApi& api_of(JointKind kind) { return kind_apis[static_cast<int>(kind)]; }

/// ODE's parameter number for the second axis is that of the first plus dParamGroup2.
int param_of(int axis, int param) { return axis == 0 ? param : param + dParamGroup2; }

Vec3 position_of(dBodyID body) { return vec3(dBodyGetPosition(body)); }

void set_position(dBodyID body, const Vec3& position) {
  dBodySetPosition(body, position.x(), position.y(), position.z());
}

/// ODE takes one point for both anchors. Body a is moved temporarily to where the anchors coincide, so that
/// each body keeps its own anchor even where the scene left a gap between the two.
void set_anchors(dJointID id, const model::Model& model, const model::Joint& joint, dBodyID body_a) {
  const auto set_anchor = api_of(joint.kind).set_anchor;
  if (set_anchor == nullptr) return;
  const Vec3 home = position_of(body_a);
  const Vec3 anchor_a = model.bodies[joint.body_a].pose.point_to_outer(joint.anchor_a);
  const Vec3 anchor_b = joint.body_b == model::no_body
                            ? joint.anchor_b
                            : model.bodies[joint.body_b].pose.point_to_outer(joint.anchor_b);
  set_position(body_a, home + (anchor_b - anchor_a));
  set_anchor(id, anchor_b.x(), anchor_b.y(), anchor_b.z());
  set_position(body_a, home);
}

void set_axes(dJointID id, const model::Model& model, const model::Joint& joint) {
  const auto set = api_of(joint.kind).set_axes;
  if (set == nullptr) return;
  const Vec3 axis1 = model.bodies[joint.body_a].pose.direction_to_outer(joint.axis1_a);
  const Vec3 axis2 = joint.body_b == model::no_body
                         ? joint.axis2_b
                         : model.bodies[joint.body_b].pose.direction_to_outer(joint.axis2_b);
  const bool has_two = model::traits_of(joint.kind).num_axes == 2;
  core::require_input(!has_two || axis1.cross(axis2).norm() > least_sine_between_axes,
                      "joint '" + joint.name + "': its two axes are parallel; turn one of them");
  set(id, axis1, axis2);
}

void set_suspension(dJointID id, const model::Joint& joint, double dt_s) {
  if (!model::traits_of(joint.kind).has_suspension() || !(joint.suspension.stiffness > 0)) return;
  const double pull = dt_s * joint.suspension.stiffness;
  const double total = pull + joint.suspension.damping;
  dJointSetHinge2Param(id, dParamSuspensionERP, pull / total);
  dJointSetHinge2Param(id, dParamSuspensionCFM, 1 / total);
}

dJointID make_joint(dWorldID world, const std::vector<dBodyID>& bodies, const model::Model& model,
                    const model::Joint& joint, double dt_s) {
  const dJointID id = api_of(joint.kind).create(world, nullptr);
  const dBodyID body_a = bodies[joint.body_a];
  dJointAttach(id, body_a, joint.body_b == model::no_body ? nullptr : bodies[joint.body_b]);
  set_anchors(id, model, joint, body_a);
  set_axes(id, model, joint);
  set_suspension(id, joint, dt_s);
  for (int axis = 0; axis < 2; ++axis) {
    if (joint.limits[axis].active()) set_limit(id, joint.kind, axis, joint.limits[axis]);
    if (joint.motors[axis].active()) set_motor(id, joint.kind, axis, joint.motors[axis]);
  }
  return id;
}

/// ODE checks the stops of an angle only if one of them lies within half a turn.
bool at_limit(dJointID joint, const KindApi& api, bool is_angle, int axis) {
  if (api.coordinate[axis] == nullptr) return false;
  const double low = api.get_param(joint, param_of(axis, dParamLoStop));
  const double high = api.get_param(joint, param_of(axis, dParamHiStop));
  const double reach = std::numbers::pi;
  const bool limited =
      is_angle ? low >= -reach || high <= reach : low > -model::infinity || high < model::infinity;
  if (!limited) return false;
  const double value = api.coordinate[axis](joint);
  return value <= low || value >= high;
}

}  // namespace

std::vector<dJointID> make_joints(dWorldID world, const std::vector<dBodyID>& bodies,
                                  const model::Model& model, double dt_s) {
  std::vector<dJointID> joints;
  joints.reserve(model.joints.size());
  for (const model::Joint& joint : model.joints) {
    joints.push_back(make_joint(world, bodies, model, joint, dt_s));
  }
  return joints;
}

void set_motor(dJointID joint, JointKind kind, int axis, const model::AxisMotor& motor) {
  const auto set = api_of(kind).set_param;
  set(joint, param_of(axis, dParamVel), motor.velocity);
  set(joint, param_of(axis, dParamFMax), motor.max_force);
}

double coordinate(dJointID joint, JointKind kind, int axis) { return api_of(kind).coordinate[axis](joint); }

/// The low stop is set twice: ODE ignores a stop that lies beyond the present value of the other one (ODE
/// manual, "Stops and motor parameters").
void set_limit(dJointID joint, JointKind kind, int axis, const model::AxisLimit& limit) {
  const auto set = api_of(kind).set_param;
  set(joint, param_of(axis, dParamLoStop), limit.low);
  set(joint, param_of(axis, dParamHiStop), limit.high);
  set(joint, param_of(axis, dParamLoStop), limit.low);
}

int count_rows(dJointID joint, JointKind kind) {
  const KindApi& api = api_of(kind);
  const model::JointTraits& traits = model::traits_of(kind);
  int rows = traits.held_rows();
  for (int axis = 0; axis < traits.num_axes; ++axis) {
    const bool driven = api.get_param(joint, param_of(axis, dParamFMax)) > 0;
    rows += driven || at_limit(joint, api, !traits.slides, axis) ? 1 : 0;
  }
  return rows;
}

}  // namespace pbmpi::ode
