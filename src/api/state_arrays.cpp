#include "api/state_arrays.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::api {
namespace {

constexpr int of_vector = 3, of_quaternion = 4;
/// A caller may have normalised in single precision, or rounded otherwise.
constexpr double length_tolerance = 1e-3;

void require_length(std::size_t length, int num_worlds, int num_bodies, int k, const char* name) {
  const std::size_t wanted = static_cast<std::size_t>(num_worlds) * static_cast<std::size_t>(num_bodies) *
                             static_cast<std::size_t>(k);
  core::require_input(length == wanted, std::string(name) + " has " + std::to_string(length) +
                                            " numbers, and [" + std::to_string(num_worlds) + "][" +
                                            std::to_string(num_bodies) + "][" + std::to_string(k) + "] are " +
                                            std::to_string(wanted));
}

std::span<const double> row(const std::vector<double>& numbers, std::size_t body, int k) {
  return std::span(numbers).subspan(body * static_cast<std::size_t>(k), static_cast<std::size_t>(k));
}

/// The `k` numbers of one body.
std::span<const double> checked(const std::vector<double>& numbers, std::size_t at, int k, const char* name,
                                int id, const std::string& body) {
  const std::span<const double> found = row(numbers, at, k);
  core::require_input(std::all_of(found.begin(), found.end(), [](double x) { return std::isfinite(x); }),
                      std::string(name) + " of body " + core::in_quotes(body) + " in world " +
                          std::to_string(id) + " is not finite; set finite numbers, or reset the world");
  return found;
}

}  // namespace

BatchState make_arrays(int num_worlds, int num_bodies) {
  const std::size_t bodies = static_cast<std::size_t>(num_worlds) * static_cast<std::size_t>(num_bodies);
  BatchState arrays;
  arrays.position.resize(of_vector * bodies);
  arrays.orientation.resize(of_quaternion * bodies);
  arrays.velocity.resize(of_vector * bodies);
  arrays.angular_velocity.resize(of_vector * bodies);
  return arrays;
}

void require_shape(const BatchState& arrays, int num_worlds, int num_bodies) {
  require_length(arrays.position.size(), num_worlds, num_bodies, of_vector, "position");
  require_length(arrays.orientation.size(), num_worlds, num_bodies, of_quaternion, "orientation");
  require_length(arrays.velocity.size(), num_worlds, num_bodies, of_vector, "velocity");
  require_length(arrays.angular_velocity.size(), num_worlds, num_bodies, of_vector, "angular_velocity");
}

void put(const model::State& state, int index, BatchState& arrays) {
  const std::size_t num_bodies = state.position.size();
  std::size_t at = static_cast<std::size_t>(index) * num_bodies;
  for (std::size_t body = 0; body < num_bodies; ++body, ++at) {
    std::copy_n(state.position[body].data(), of_vector, &arrays.position[of_vector * at]);
    std::copy_n(&state.orientation[body].w, of_quaternion, &arrays.orientation[of_quaternion * at]);
    std::copy_n(state.velocity[body].data(), of_vector, &arrays.velocity[of_vector * at]);
    std::copy_n(state.angular_velocity[body].data(), of_vector, &arrays.angular_velocity[of_vector * at]);
  }
}

void take(const BatchState& arrays, int index, int id, const model::Model& model, model::State& state) {
  const std::size_t num_bodies = state.position.size();
  std::size_t at = static_cast<std::size_t>(index) * num_bodies;
  for (std::size_t body = 0; body < num_bodies; ++body, ++at) {
    const std::string& name = model.bodies[body].name;
    const auto numbers = [&](const std::vector<double>& all, int k, const char* what) {
      return checked(all, at, k, what, id, name).data();
    };
    const double* q = numbers(arrays.orientation, of_quaternion, "orientation");
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    core::require_input(std::abs(length - 1) <= length_tolerance,
                        "orientation of body " + core::in_quotes(name) + " in world " + std::to_string(id) +
                            " has the length " + std::to_string(length) +
                            "; a rotation is a quaternion (w, x, y, z) of length 1");
    std::copy_n(q, of_quaternion, &state.orientation[body].w);
    std::copy_n(numbers(arrays.position, of_vector, "position"), of_vector, state.position[body].data());
    std::copy_n(numbers(arrays.velocity, of_vector, "velocity"), of_vector, state.velocity[body].data());
    std::copy_n(numbers(arrays.angular_velocity, of_vector, "angular_velocity"), of_vector,
                state.angular_velocity[body].data());
  }
}

}  // namespace pbmpi::api
