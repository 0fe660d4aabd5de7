#include "mujoco/constraints.h"

#include <algorithm>

#include "core/error.h"

namespace pbmpi::mujoco {
namespace {

using model::Vec3;

/// MuJoCo has no constraint that keeps two axes parallel: two points of a hinge's axis hold it, at this
/// distance from its anchor [m].
constexpr double half_axis_m = 0.1;

bool may_be_pinned(const model::Model& model, int joint, int axis) {
  const model::AxisLimit& limit = model.joints[joint].limits[axis];
  if (limit.active() && limit.low == limit.high) return true;
  return axis == 0 && std::ranges::any_of(model.events, [&](const model::Event& event) {
           return event.kind == model::EventKind::steer && event.joint == joint;
         });
}

void add_pins(const model::Model& model, int body, const Link& link, std::vector<Pin>& pins) {
  for (std::size_t k = 0; k < link.axes.size(); ++k) {
    const LinkAxis& axis = link.axes[k];
    if (axis.is_suspension || axis.freedom == Freedom::ball) continue;
    if (may_be_pinned(model, link.hold.joint, axis.axis))
      pins.push_back({link.hold.joint, axis.axis, body, k});
  }
}

void add_closures(const model::Model& model, const model::Joint& joint, std::vector<Closure>& closures) {
  const model::Pose a = start_of(model, joint.body_a), b = start_of(model, joint.body_b);
  Closure closure{joint.body_a,   joint.body_b,   joint.anchor_a,
                  joint.anchor_b, relative(a, b), closing_of(joint.kind) == Closing::weld};
  if (closing_of(joint.kind) != Closing::two_points) {
    closures.push_back(closure);
    return;
  }
  const Vec3 in_b = b.orientation.to_eigen().conjugate() * a.direction_to_outer(joint.axis1_a);
  for (const double reach : {-half_axis_m, half_axis_m}) {
    closure.point_a = joint.anchor_a + reach * joint.axis1_a;
    closure.point_b = joint.anchor_b + reach * in_b;
    closures.push_back(closure);
  }
}

}  // namespace

std::string closing_problem(const model::Joint& joint, bool has_controls) {
  if (closing_of(joint.kind) == Closing::none)
    return "joint '" + joint.name +
           "' closes a loop, and MuJoCo can close one only with a ball joint, a hinge or a fixed joint";
  if (has_controls)
    return "joint '" + joint.name +
           "' closes a loop, and MuJoCo knows no limit, motor or strength of a joint that does";
  return {};
}

Constraints make_constraints(const model::Model& model, const JointTree& tree,
                             const std::vector<Link>& links) {
  Constraints constraints;
  for (int body = 0; body < model.num_bodies(); ++body) add_pins(model, body, links[body], constraints.pins);
  if (tree.closing.empty()) return constraints;
  const std::vector<bool> controls = joints_with_controls(model);
  for (const int joint : tree.closing) {
    const std::string problem = closing_problem(model.joints[joint], controls[joint]);
    core::require_input(problem.empty(), "mujoco: " + problem + "; use another stepper, or open the loop");
    add_closures(model, model.joints[joint], constraints.closures);
  }
  return constraints;
}

/// eq_data holds both points of a "connect"; for a "weld" it holds the point, and then position and
/// orientation of one body in the other (MuJoCo, XML reference, "equality").
void place_closures(const Constraints& constraints, mjModel& compiled) {
  for (std::size_t i = 0; i < constraints.closures.size(); ++i) {
    const Closure& closure = constraints.closures[i];
    mjtNum* data = compiled.eq_data + mjNEQDATA * (constraints.pins.size() + i);
    if (closure.welds) continue;
    std::copy_n(closure.point_a.data(), 3, data);
    std::copy_n(closure.point_b.data(), 3, data + 3);
  }
}

}  // namespace pbmpi::mujoco
