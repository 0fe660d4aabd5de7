#include "stability/suspensions.h"

#include "model/joint_traits.h"

namespace pbmpi::stability {
namespace {

using model::State;
using model::Vec3;

/// Displacement of a suspension from its rest position [m].
double travel_of(const Suspension& suspension, const State& state) {
  const model::Pose a = state.pose(suspension.body_a), b = state.pose(suspension.body_b);
  const Vec3 axis = a.direction_to_outer(suspension.axis);
  return axis.dot(a.point_to_outer(suspension.anchor_a) - b.point_to_outer(suspension.anchor_b));
}

}  // namespace

std::vector<Suspension> suspensions_of(const model::Model& model) {
  std::vector<Suspension> all;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const model::Joint& joint = model.joints[i];
    if (!traits_of(joint.kind).has_suspension() || joint.suspension.stiffness <= 0) continue;
    all.push_back({i, joint.body_a, joint.body_b, joint.anchor_a, joint.anchor_b, joint.axis1_a,
                   joint.suspension.stiffness});
  }
  return all;
}

double energy_of(const Suspension& suspension, const State& state) {
  if (state.is_broken(suspension.joint)) return 0;
  const double travel = travel_of(suspension, state);
  return 0.5 * suspension.stiffness * travel * travel;
}

}  // namespace pbmpi::stability
