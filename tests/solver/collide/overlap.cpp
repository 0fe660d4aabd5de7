#include "solver/collide/overlap.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace pbmpi::solver {
namespace {

using model::Shape;
using model::Vec3;

constexpr int num_directions = 1500;

/// Directions distributed evenly over the sphere, on a spiral.
std::vector<Vec3> make_directions() {
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3> directions;
  for (int i = 0; i < num_directions; ++i) {
    const double z = 1 - (2 * i + 1.0) / num_directions, r = std::sqrt(1 - z * z), turn = golden_angle * i;
    directions.emplace_back(r * std::cos(turn), r * std::sin(turn), z);
  }
  return directions;
}

/// Descends from n by steps in twelve directions, which shrink when none leads down.
double downhill(const PlacedGeom& a, const PlacedGeom& b, Vec3 n) {
  constexpr double least_step = 1e-8, shrink = 0.6;
  double overlap = overlap_along(a, b, n), step = 0.08;
  for (int i = 0; i < 600 && step > least_step; ++i) {
    const Vec3 across = n.cross(std::abs(n.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY()).normalized();
    const Vec3 other = n.cross(across);
    bool lower = false;
    for (int way = 0; way < 12 && !lower; ++way) {
      const double turn = way * std::numbers::pi / 6 + i;  // other directions at each step, because of kinks
      const Vec3 next = (n + step * (std::cos(turn) * across + std::sin(turn) * other)).normalized();
      const double value = overlap_along(a, b, next);
      if (value < overlap) {
        overlap = value;
        n = next;
        lower = true;
      }
    }
    if (!lower) step *= shrink;
  }
  return overlap;
}

}  // namespace

double support(const PlacedGeom& solid, const Vec3& n) {
  const Vec3 local = solid.rotation.transpose() * n;
  const auto& size = solid.geom.size;
  switch (solid.geom.shape) {
    case Shape::sphere:
      return size[0];
    case Shape::box:
      return 0.5 *
             (size[0] * std::abs(local.x()) + size[1] * std::abs(local.y()) + size[2] * std::abs(local.z()));
    case Shape::capsule:
      return size[0] + 0.5 * size[1] * std::abs(local.z());
    case Shape::cylinder:
      return size[0] * std::hypot(local.x(), local.y()) + 0.5 * size[1] * std::abs(local.z());
    case Shape::plane:
    case Shape::hull:
    case Shape::mesh:
      break;
  }
  return 0;
}

double overlap_along(const PlacedGeom& a, const PlacedGeom& b, const Vec3& n) {
  return support(a, n) + support(b, n) - n.dot(a.centre - b.centre);
}

double least_overlap(const PlacedGeom& a, const PlacedGeom& b) {
  static const std::vector<Vec3> directions = make_directions();
  struct Start {
    double overlap;
    Vec3 n;
  };
  constexpr std::size_t num_starts = 6;
  constexpr double near = 0.97;  // cosine: one start per neighbourhood
  std::vector<Start> all, starts;
  for (const Vec3& n : directions) all.push_back({overlap_along(a, b, n), n});
  std::sort(all.begin(), all.end(), [](const Start& s, const Start& t) { return s.overlap < t.overlap; });
  for (const Start& start : all) {
    if (starts.size() == num_starts) break;
    const bool taken = std::any_of(starts.begin(), starts.end(),
                                   [&](const Start& other) { return other.n.dot(start.n) > near; });
    if (!taken) starts.push_back(start);
  }
  double least = all.front().overlap;
  for (const Start& start : starts) least = std::min(least, downhill(a, b, start.n));
  return least;
}

double distance_outside(const PlacedGeom& solid, const Vec3& place) {
  const Vec3 local = solid.rotation.transpose() * (place - solid.centre);
  const auto& size = solid.geom.size;
  const auto beyond = [](double x, double half) { return std::max(std::abs(x) - half, 0.0); };
  const double beside = std::hypot(local.x(), local.y());
  switch (solid.geom.shape) {
    case Shape::sphere:
      return beyond(local.norm(), size[0]);
    case Shape::box:
      return Vec3(beyond(local.x(), size[0] / 2), beyond(local.y(), size[1] / 2),
                  beyond(local.z(), size[2] / 2))
          .norm();
    case Shape::capsule:
      return beyond(std::hypot(beside, beyond(local.z(), size[1] / 2)), size[0]);
    case Shape::cylinder:
      return std::hypot(beyond(beside, size[0]), beyond(local.z(), size[1] / 2));
    case Shape::plane:
    case Shape::hull:
    case Shape::mesh:
      break;
  }
  return 0;
}

}  // namespace pbmpi::solver
