#include "solver/parts/quiet_islands.h"

#include <algorithm>
#include <cmath>

#include "geometry/measures.h"

namespace pbmpi::solver {
namespace {

/// Distance from a to the nearer of the two quaternions that represent b's orientation.
double distance(const model::Quat& a, const model::Quat& b) {
  const auto square = [](double w, double x, double y, double z) { return w * w + x * x + y * y + z * z; };
  return std::sqrt(std::min(square(a.w - b.w, a.x - b.x, a.y - b.y, a.z - b.z),
                            square(a.w + b.w, a.x + b.x, a.y + b.y, a.z + b.z)));
}

}  // namespace

QuietIslands::QuietIslands(const model::Model& model, const stepping::StepperSettings& settings)
    : dt_s_(settings.dt_s),
      tolerance_m_(settings.tolerance_m),
      far_(model),
      is_quiet_(model.bodies.size(), 0) {
  for (const double size : geometry::sizes_of(model)) radius_m_.push_back(size / 2);
}

double QuietIslands::way_m(int body, const model::State& state) const {
  const auto b = static_cast<std::size_t>(body);
  return dt_s_ * (state.velocity[b].norm() + radius_m_[b] * state.angular_velocity[b].norm());
}

/// Quaternions that differ by a small rotation are half its angle apart.
double QuietIslands::way_between_m(int body, const model::State& before, const model::State& after) const {
  const auto b = static_cast<std::size_t>(body);
  return (after.position[b] - before.position[b]).norm() +
         2 * radius_m_[b] * distance(after.orientation[b], before.orientation[b]);
}

void QuietIslands::foresee_none() {
  for (const int body : quiet_) is_quiet_[static_cast<std::size_t>(body)] = 0;
  quiet_.clear();
}

/// NaN counts as far.
void QuietIslands::foresee(std::span<const int> bodies, StepIslands& islands, const model::State& before) {
  foresee_none();
  far_.clear(bodies);
  for (const int body : bodies) {
    if (!is_slow(body, before)) far_.mark(body, islands);
  }
  for (const int body : bodies) {
    if (far_.has(body, islands)) continue;
    is_quiet_[static_cast<std::size_t>(body)] = 1;
    quiet_.push_back(body);
  }
}

void QuietIslands::judge(std::span<const int> bodies, StepIslands& islands, const model::State& before,
                         const model::State& after, std::vector<int>& far) {
  far_.clear(bodies);
  bool any = false;
  for (const int body : bodies) {
    const double way = std::max(way_m(body, after), way_between_m(body, before, after));
    if (way <= tolerance_m_) continue;
    far_.mark(body, islands);
    any = true;
  }
  if (!any) return;
  for (const int body : bodies) {
    if (far_.has(body, islands)) far.push_back(body);
  }
}

}  // namespace pbmpi::solver
