#include "stepping/observables.h"

#include "model/joint_gap.h"
#include "model/mechanics.h"

namespace pbmpi::stepping {
namespace {

std::array<double, 3> components(const model::Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

}  // namespace

void observe_state(const model::Model& model, const model::State& state, Observables& seen) {
  observe_bodies(model, state, seen);
  seen.energy_j = model::mechanical_energy(model, state);
  seen.joint_gap_m = model::max_joint_gap(model, state);
}

void observe_bodies(const model::Model& model, const model::State& state, Observables& seen) {
  seen.nonfinite = model::count_nonfinite(state);
  seen.linear_momentum = components(model::linear_momentum(model, state));
  seen.angular_momentum = components(model::angular_momentum(model, state));
}

}  // namespace pbmpi::stepping
