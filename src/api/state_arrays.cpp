#include "api/state_arrays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>

#include "core/error.h"
#include "core/text.h"
#include "model/state_parts.h"

namespace pbmpi::api {
namespace {

/// The array of each of model::body_columns.
constexpr std::array<std::vector<double> BatchState::*, model::body_columns.size()> members = {
    &BatchState::position, &BatchState::orientation, &BatchState::velocity, &BatchState::angular_velocity};
/// A caller may have normalised in single precision, or rounded otherwise.
constexpr double length_tolerance = 1e-3;

/// Throws unless the numbers of body `body` in world `id` are finite.
void require_finite(std::span<const double> numbers, const char* name, int id, const std::string& body) {
  core::require_input(std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); }),
                      std::string(name) + " of body " + core::in_quotes(body) + " in world " +
                          std::to_string(id) + " is not finite; set finite numbers, or reset the world");
}

void require_turn(const model::Quat& q, int id, const std::string& body) {
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  core::require_input(std::abs(length - 1) <= length_tolerance,
                      "orientation of body " + core::in_quotes(body) + " in world " + std::to_string(id) +
                          " has the length " + std::to_string(length) +
                          "; a rotation is a quaternion (w, x, y, z) of length 1");
}

}  // namespace

BatchState make_arrays(int num_worlds, int num_bodies) {
  const std::size_t bodies = static_cast<std::size_t>(num_worlds) * static_cast<std::size_t>(num_bodies);
  BatchState arrays;
  for (std::size_t i = 0; i < members.size(); ++i)
    (arrays.*members[i]).resize(model::body_columns[i].width() * bodies);
  return arrays;
}

void require_shape(const BatchState& arrays, int num_worlds, int num_bodies) {
  const BatchState wanted = make_arrays(num_worlds, num_bodies);
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::size_t length = (arrays.*members[i]).size(), fit = (wanted.*members[i]).size();
    const model::BodyColumn& column = model::body_columns[i];
    core::require_input(length == fit, std::string(column.name) + " has " + std::to_string(length) +
                                           " numbers, and [" + std::to_string(num_worlds) + "][" +
                                           std::to_string(num_bodies) + "][" +
                                           std::to_string(column.width()) + "] are " + std::to_string(fit));
  }
}

void put(const model::State& state, int index, BatchState& arrays) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    const std::span<const double> numbers = model::body_columns[i].of(state);
    std::ranges::copy(numbers, (arrays.*members[i]).begin() + index * std::ssize(numbers));
  }
}

void take(const BatchState& arrays, int index, int id, const model::Model& model, model::State& state) {
  for (std::size_t i = 0; i < members.size(); ++i) {
    const model::BodyColumn& column = model::body_columns[i];
    const std::span<double> numbers = column.of(state);
    std::copy_n((arrays.*members[i]).begin() + index * std::ssize(numbers), numbers.size(), numbers.begin());
    for (int body = 0; body < state.num_bodies(); ++body)
      require_finite(column.of(state, body), column.name, id, model.bodies[body].name);
  }
  for (int body = 0; body < state.num_bodies(); ++body)
    require_turn(state.orientation[body], id, model.bodies[body].name);
}

}  // namespace pbmpi::api
