#include "stepping/observables.h"

namespace pbmpi::stepping {
namespace {

std::array<double, 3> components(const model::Vec3& vector) { return {vector.x(), vector.y(), vector.z()}; }

void take_bodies(const model::State& state, const model::Mechanics& mechanics, Observables& seen) {
  seen.nonfinite = model::count_nonfinite(state);
  seen.linear_momentum = components(mechanics.linear_momentum);
  seen.angular_momentum = components(mechanics.angular_momentum);
}

}  // namespace

void StateObserver::observe(const model::State& state, Observables& seen) const {
  const model::Mechanics mechanics = mechanics_.measure(state);
  take_bodies(state, mechanics, seen);
  seen.energy_j = mechanics.energy_j;
  seen.joint_gap_m = gaps_.largest(state);
}

void observe_state(const model::Model& model, const model::State& state, Observables& seen) {
  StateObserver(model).observe(state, seen);
}

void observe_bodies(const model::Model& model, const model::State& state, Observables& seen) {
  take_bodies(state, model::MechanicsMeter(model).measure(state), seen);
}

}  // namespace pbmpi::stepping
