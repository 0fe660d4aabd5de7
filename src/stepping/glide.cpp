#include "stepping/glide.h"

namespace pbmpi::stepping {

void glide(double seconds, model::State& state) {
  for (std::size_t body = 0; body < state.position.size(); ++body) {
    state.position[body] += seconds * state.velocity[body];
    const core::Vec3 half_turn = 0.5 * seconds * state.angular_velocity[body];
    Eigen::Quaterniond orientation = state.orientation[body].to_eigen();
    const Eigen::Quaterniond change =
        Eigen::Quaterniond(0, half_turn.x(), half_turn.y(), half_turn.z()) * orientation;
    orientation.coeffs() += change.coeffs();
    state.orientation[body] = core::Quat::from_eigen(orientation.normalized());
  }
}

}  // namespace pbmpi::stepping
