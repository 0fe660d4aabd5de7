#include "stability/passage.h"

#include <algorithm>
#include <cmath>

#include "geometry/geometry.h"
#include "geometry/measures.h"
#include "geometry/ray_cast.h"

namespace pbmpi::stability {
namespace {

using model::BodyPose;
using model::Geom;
using model::Shape;
using model::State;
using model::Vec3;

/// Radius [m] of the largest ball about the body's centre of mass that fits into the geom; 0 or less if the
/// centre lies outside.
double inner_radius(const Geom& geom) {
  const Vec3 centre = geom.local.orientation.to_eigen().conjugate() * -geom.local.position;
  const geometry::Extent extent = geometry::extent_of(geom);
  const auto side = [&](int axis) {
    return extent.half[static_cast<std::size_t>(axis)] - std::abs(centre[axis]);
  };
  if (geom.shape == Shape::plane) return 0;
  if (geom.shape == Shape::hull) {
    double least = model::infinity;
    for (const model::Hull::Face& face : geom.hull->faces)
      least = std::min(least, face.height - face.normal.dot(centre));
    return least;
  }
  if (extent.ball > 0) return extent.ball - Vec3(centre.x(), centre.y(), std::max(0.0, -side(2))).norm();
  if (extent.disc > 0)
    return std::min(extent.disc - std::sqrt(centre.x() * centre.x() + centre.y() * centre.y()), side(2));
  return std::min({side(0), side(1), side(2)});
}

BodyPose pose_of(const State& state, int body) {
  if (body == model::no_body) return geometry::static_pose();
  return geometry::body_pose({state.position[body], state.orientation[body]});
}

/// Does a path enter the geom of a body from outside?
bool enters(const Geom& geom, const BodyPose& body, const Vec3& from, const Vec3& way) {
  return geometry::enter(geom, geometry::geom_pose(geom, body), from, way).has_value();
}

/// How far the path continues after it has crossed the geom from side to side, as a share of its length;
/// nothing if it does not cross the whole geom.
std::optional<double> share_beyond(const Geom& geom, const BodyPose& body, const Vec3& from,
                                   const Vec3& way) {
  if (!enters(geom, body, from, way)) return std::nullopt;
  const auto back = geometry::enter(geom, geometry::geom_pose(geom, body), from + way, -way);
  return back ? std::optional<double>(back->share) : std::nullopt;
}

/// Squared distance between a point and the segment from + s way, s from 0 to 1.
double squared_distance(const Vec3& point, const Vec3& from, const Vec3& way) {
  const Vec3 to_point = point - from;
  const double share = std::clamp(to_point.dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (to_point - share * way).squaredNorm();
}

}  // namespace

PassageFinder::PassageFinder(const model::Model& model) : model_(&model), rule_(model) {
  std::vector<Mover> best(model.bodies.size());
  const std::vector<double> sizes = geometry::sizes_of(model);
  for (int i = 0; i < static_cast<int>(model.geoms.size()); ++i) {
    const Geom& geom = model.geoms[i];
    if (geom.shape == Shape::plane) {
      const Vec3 normal = geom.local.orientation.to_eigen() * Vec3::UnitZ();
      if (geom.body == model::no_body) planes_.push_back({i, normal, normal.dot(geom.local.position)});
      continue;
    }
    const double radius = geometry::bounding_radius(geom);
    if (geom.body == model::no_body) {
      static_.push_back({i, geom.body, geom.local.position, radius});
      continue;
    }
    moving_.push_back({i, geom.body, Vec3::Zero(), radius + geom.local.position.norm()});
    const double inner = inner_radius(geom);
    if (inner > best[geom.body].radius) best[geom.body] = {geom.body, i, inner, sizes[geom.body]};
  }
  std::vector<geometry::Box> boxes;
  boxes.reserve(static_.size());
  for (const Solid& solid : static_)
    boxes.push_back(geometry::swept_box(solid.centre, solid.radius, Vec3::Zero()));
  static_tree_.set(boxes);
  std::ranges::copy_if(best, std::back_inserter(movers_), [](const Mover& one) { return one.radius > 0; });
  std::ranges::stable_sort(moving_, {}, &Solid::body);
  extents_.resize(model.bodies.size());
  for (std::size_t body = 0; body < extents_.size(); ++body) {
    const int actor = model.bodies[body].actor;
    const bool touch_each_other = model.actors[static_cast<std::size_t>(actor)].self_collision;
    extents_[body].actor = touch_each_other ? -1 - static_cast<int>(body) : actor;
  }
  for (int i = 0; i < static_cast<int>(moving_.size()); ++i) {
    Extent& extent = extents_[static_cast<std::size_t>(moving_[static_cast<std::size_t>(i)].body)];
    if (extent.last_solid == 0) extent.first_solid = i;
    extent.last_solid = i + 1;
    extent.radius = std::max(extent.radius, moving_[static_cast<std::size_t>(i)].radius);
  }
  for (int i = 0; i < static_cast<int>(movers_.size()); ++i) {
    const Mover& mover = movers_[static_cast<std::size_t>(i)];
    extents_[static_cast<std::size_t>(mover.body)].mover = i;
    extents_[static_cast<std::size_t>(mover.body)].size = mover.size;
    least_size_ = std::min(least_size_, mover.size);
    least_radius_ = std::min(least_radius_, mover.radius);
  }
}

std::optional<Passage> PassageFinder::find(const State& before, std::span<const Vec3> from,
                                           const State& after, Pace pace) const {
  find_close_pairs(from, after);
  if (may_pass_static(after, pace)) {
    for (const Mover& mover : movers_) {
      const auto body = static_cast<std::size_t>(mover.body);
      if (auto found = through_planes(mover, from[body], after.position[body])) return found;
      const double least_way = pace == Pace::fast ? mover.radius : 0;
      if (static_.empty() || !(squared_lengths_[body] > least_way * least_way)) continue;
      if (auto found = through_static(mover, from[body], ways_[body])) return found;
    }
  }
  for (const Pair& pair : close_) {
    if (auto found = through_body(pair.first, pair.second, before, after)) return found;
    if (auto found = through_body(pair.second, pair.first, before, after)) return found;
  }
  return std::nullopt;
}

/// Tests bounds that hold for all movers, without looking at any single mover, which would be most of the
/// cost.
bool PassageFinder::may_pass_static(const State& after, Pace pace) const {
  const auto may_be_behind = [&](const Plane& plane) {
    return std::ranges::any_of(after.position, [&](const Vec3& centre) {
      return !(plane.normal.dot(centre) - plane.height > -least_size_);
    });
  };
  if (std::ranges::any_of(planes_, may_be_behind)) return true;
  const double least_way = pace == Pace::fast ? least_radius_ : 0;
  return !static_.empty() && std::ranges::any_of(squared_lengths_, [&](double squared_length) {
    return squared_length > least_way * least_way;
  });
}

/// Bodies have passed through each other only if their paths differ by twice the size of the smaller one. At
/// least one of the paths then differs by that size from any third path, for which the mean is taken: bodies
/// that fly together are not a pair.
void PassageFinder::find_close_pairs(std::span<const Vec3> from, const State& after) const {
  const std::size_t num_bodies = extents_.size();
  ways_.resize(num_bodies);
  squared_lengths_.resize(num_bodies);
  far_.clear();
  close_.clear();
  mean_way_ = Vec3::Zero();
  for (std::size_t body = 0; body < num_bodies; ++body) {
    ways_[body] = after.position[body] - from[body];
    squared_lengths_[body] = ways_[body].squaredNorm();
    mean_way_ += ways_[body];
  }
  if (num_bodies > 0) mean_way_ /= static_cast<double>(num_bodies);
  for (std::size_t body = 0; body < num_bodies; ++body) {
    if (is_far(body)) far_.push_back(static_cast<int>(body));
  }
  if (far_.empty()) return;
  reaches_.resize(num_bodies);
  for (std::size_t body = 0; body < num_bodies; ++body) {
    const double reach = std::sqrt(squared_lengths_[body]) + extents_[body].radius;
    reaches_[body] = geometry::swept_box(after.position[body], reach, Vec3::Zero());
  }
  reach_tree_.set(reaches_);
  for (const int far : far_) find_close_to(far);
}

bool PassageFinder::is_far(std::size_t body) const {
  return (ways_[body] - mean_way_).squaredNorm() >= least_size_ * least_size_;
}

/// Pairs in ascending order, so that the first passage is the same however they are found.
void PassageFinder::find_close_to(int far) const {
  const auto a = static_cast<std::size_t>(far);
  const Extent& one = extents_[a];
  const auto num_before = std::ssize(close_);
  reach_tree_.for_each_near(reaches_[a], [&](int near) {
    const auto b = static_cast<std::size_t>(near);
    const Extent& other = extents_[b];
    const double least_way = 2 * std::min(one.size, other.size);
    if (one.actor == other.actor || (ways_[a] - ways_[b]).squaredNorm() < least_way * least_way) return;
    const bool is_second_look = b < a && is_far(b);
    if (!is_second_look) close_.push_back({far, near});
  });
  std::sort(close_.begin() + num_before, close_.end(),
            [](const Pair& p, const Pair& q) { return p.second < q.second; });
}

std::optional<Passage> PassageFinder::through_planes(const Mover& mover, const Vec3& from,
                                                     const Vec3& to) const {
  for (const Plane& plane : planes_) {
    const double height = plane.normal.dot(to) - plane.height;
    if (height > -mover.size || plane.normal.dot(from) - plane.height <= -mover.size) continue;
    if (rule_.may_touch(mover.geom, plane.geom)) return Passage{mover.body, plane.geom, -height};
  }
  return std::nullopt;
}

std::optional<Passage> PassageFinder::through_static(const Mover& mover, const Vec3& from,
                                                     const Vec3& way) const {
  near_.clear();
  static_tree_.for_each_near(geometry::swept_box(from, 0, way),
                             [this](int solid) { near_.push_back(solid); });
  std::ranges::sort(near_);
  for (const int near : near_) {
    const Solid& solid = static_[static_cast<std::size_t>(near)];
    if (squared_distance(solid.centre, from, way) > solid.radius * solid.radius) continue;
    if (!rule_.may_touch(mover.geom, solid.geom)) continue;
    const Geom& geom = model_->geoms[solid.geom];
    const BodyPose stands = geometry::static_pose();
    const auto beyond = share_beyond(geom, stands, from, way);
    const bool sticks_out = geometry::least_half_extent(geom) < mover.radius;
    if (beyond || (sticks_out && enters(geom, stands, from, way)))
      return Passage{mover.body, solid.geom, beyond.value_or(0) * way.norm()};
  }
  return std::nullopt;
}

std::optional<Passage> PassageFinder::through_body(int body, int other, const State& before,
                                                   const State& after) const {
  const int index = extents_[static_cast<std::size_t>(body)].mover;
  if (index < 0) return std::nullopt;
  const Mover& mover = movers_[static_cast<std::size_t>(index)];
  const Extent& extent = extents_[static_cast<std::size_t>(other)];
  const Vec3& to = after.position[mover.body];
  const Vec3& centre = after.position[other];
  const Vec3 way = ways_[static_cast<std::size_t>(body)] - (centre - before.position[other]);
  const double least_way = 2 * mover.size;
  if (way.squaredNorm() < least_way * least_way) return std::nullopt;
  for (int i = extent.first_solid; i < extent.last_solid; ++i) {
    const Solid& solid = moving_[static_cast<std::size_t>(i)];
    if (squared_distance(centre, to - way, way) > solid.radius * solid.radius) continue;
    if (!rule_.may_touch(mover.geom, solid.geom)) continue;
    const Geom& geom = model_->geoms[solid.geom];
    BodyPose pose = pose_of(after, other);
    auto beyond = share_beyond(geom, pose, to - way, way);
    if (!beyond || *beyond * way.norm() < least_way) continue;
    std::ranges::copy(pose_of(before, other).rotation, pose.rotation);
    beyond = share_beyond(geom, pose, to - way, way);
    if (beyond) return Passage{body, solid.geom, *beyond * way.norm()};
  }
  return std::nullopt;
}

std::vector<char> PassageFinder::find_inside(const State& state) const {
  std::vector<geometry::Box> boxes;
  boxes.reserve(moving_.size());
  for (const Solid& solid : moving_)
    boxes.push_back(geometry::swept_box(state.position[solid.body], solid.radius, Vec3::Zero()));
  geometry::BoxTree moving_tree;
  moving_tree.set(boxes);
  std::vector<char> inside(model_->bodies.size(), 0);
  for (const Mover& mover : movers_) {
    char& is_in = inside[static_cast<std::size_t>(mover.body)];
    const geometry::Box centre = geometry::swept_box(state.position[mover.body], 0, Vec3::Zero());
    const auto look_in = [&](const std::vector<Solid>& solids) {
      return [&](int solid) {
        if (is_in == 0 && is_inside(state, mover, solids[static_cast<std::size_t>(solid)])) is_in = 1;
      };
    };
    static_tree_.for_each_near(centre, look_in(static_));
    moving_tree.for_each_near(centre, look_in(moving_));
  }
  return inside;
}

bool PassageFinder::is_inside(const State& state, const Mover& mover, const Solid& solid) const {
  const Vec3& point = state.position[mover.body];
  const Vec3& centre = solid.body == model::no_body ? solid.centre : state.position[solid.body];
  if ((point - centre).squaredNorm() > solid.radius * solid.radius) return false;
  if (!rule_.may_touch(mover.geom, solid.geom)) return false;
  const Geom& geom = model_->geoms[solid.geom];
  const BodyPose pose = pose_of(state, solid.body);
  // If the point is inside, a path to it from outside enters the geom, and the path back out does not.
  const Vec3 way = Vec3::UnitX() * (3 * solid.radius);
  return enters(geom, pose, point - way, way) && !enters(geom, pose, point, -way);
}

}  // namespace pbmpi::stability
