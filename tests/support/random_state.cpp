#include "support/random_state.h"

#include "core/random.h"

namespace pbmpi::support {

model::State random_state(const model::Model& model, std::uint64_t seed) {
  std::uint64_t next = 0;
  const auto number = [&] { return 2 * core::to_unit(core::mix_key(seed, next++, 0)) - 1; };
  const auto vector = [&] {
    const double x = number(), y = number();
    return model::Vec3(x, y, number());
  };
  model::State state = model::initial_state(model);
  for (std::size_t body = 0; body < model.bodies.size(); ++body) {
    const model::Vec3 axis = vector();
    const Eigen::Quaterniond turn(number(), axis.x(), axis.y(), axis.z());
    state.position[body] = vector();
    state.orientation[body] = model::Quat::from_eigen(turn.normalized());
    state.velocity[body] = vector();
    state.angular_velocity[body] = vector();
  }
  return state;
}

}  // namespace pbmpi::support
