#include "stability/passage.h"

#include <algorithm>
#include <cmath>

#include "geometry/geometry.h"
#include "geometry/ray_cast.h"
#include "stability/body_size.h"

namespace pbmpi::stability {
namespace {

using model::BodyPose;
using model::Geom;
using model::Shape;
using model::State;
using model::Vec3;

/// Radius [m] of the largest ball about the body's centre of mass that the geom holds; 0 or less if the
/// centre lies outside.
double inner_radius(const Geom& geom) {
  const Vec3 centre = geom.local.orientation.to_eigen().conjugate() * -geom.local.position;
  const geometry::Extent extent = geometry::extent_of(geom);
  const auto side = [&](int axis) {
    return extent.half[static_cast<std::size_t>(axis)] - std::abs(centre[axis]);
  };
  switch (geom.shape) {
    case Shape::sphere:
      return geom.size[0] - centre.norm();
    case Shape::capsule: {
      const Vec3 off(centre.x(), centre.y(), std::max(0.0, -side(2)));
      return geom.size[0] - off.norm();
    }
    case Shape::cylinder:
      return std::min(geom.size[0] - std::hypot(centre.x(), centre.y()), side(2));
    case Shape::box:
      return std::min({side(0), side(1), side(2)});
    case Shape::plane:
      break;
  }
  return 0;
}

BodyPose pose_of(const State& state, int body) {
  if (body == model::no_body) return geometry::static_pose();
  BodyPose pose{};
  for (int axis = 0; axis < 3; ++axis) pose.position[axis] = state.position[body][axis];
  const core::Quat& q = state.orientation[body];
  geometry::to_rotation(q.w, q.x, q.y, q.z, pose.rotation);
  return pose;
}

/// Does a way come into the geom of a body from outside?
bool enters(const Geom& geom, const BodyPose& body, const Vec3& from, const Vec3& way) {
  return geometry::enter(geom, geometry::geom_pose(geom, body), from, way).has_value();
}

/// How far the way goes on after it has crossed the geom from side to side, as a share of its length; nothing
/// if it does not cross the whole of it.
std::optional<double> share_beyond(const Geom& geom, const BodyPose& body, const Vec3& from,
                                   const Vec3& way) {
  if (!enters(geom, body, from, way)) return std::nullopt;
  const auto back = geometry::enter(geom, geometry::geom_pose(geom, body), from + way, -way);
  return back ? std::optional<double>(back->share) : std::nullopt;
}

/// Square of the distance between a point and the line of points from + s way, s from 0 to 1.
double squared_distance(const Vec3& point, const Vec3& from, const Vec3& way) {
  const Vec3 to_point = point - from;
  const double share = std::clamp(to_point.dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (to_point - share * way).squaredNorm();
}

}  // namespace

PassageFinder::PassageFinder(const model::Model& model) : model_(&model), rule_(model) {
  std::vector<Mover> best(model.bodies.size());
  const std::vector<double> sizes = sizes_of(model);
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
  std::ranges::copy_if(best, std::back_inserter(movers_), [](const Mover& one) { return one.radius > 0; });
  for (const Mover& mover : movers_) least_size_ = std::min(least_size_, mover.size);
}

std::optional<Passage> PassageFinder::find(const State& before, std::span<const Vec3> from,
                                           const State& after, Pace pace) const {
  std::vector<Solid> far_movers;  // bodies that themselves went as far as the smallest is large
  for (const Solid& solid : moving_) {
    const Vec3 way = after.position[solid.body] - before.position[solid.body];
    if (way.squaredNorm() >= least_size_ * least_size_) far_movers.push_back(solid);
  }
  for (const Mover& mover : movers_) {
    const Vec3& start = from[static_cast<std::size_t>(mover.body)];
    const Vec3& end = after.position[mover.body];
    if (auto found = through_planes(mover, start, end)) return found;
    const Vec3 way = end - start;
    const double length = way.norm();
    if (!(length > (pace == Pace::fast ? mover.radius : 0))) continue;
    if (auto found = through_static(mover, start, way)) return found;
    // Of two bodies that are twice a size apart from where they were, as seen from each other, one went a
    // size by itself.
    const std::vector<Solid>& others = length < mover.size ? far_movers : moving_;
    if (auto found = through_bodies(mover, others, before, way, after)) return found;
  }
  return std::nullopt;
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
  for (const Solid& solid : static_) {
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

std::optional<Passage> PassageFinder::through_bodies(const Mover& mover, std::span<const Solid> others,
                                                     const State& before, const Vec3& own_way,
                                                     const State& after) const {
  const Vec3& to = after.position[mover.body];
  const double least_way = 2 * mover.size;
  for (const Solid& solid : others) {
    const Vec3& centre = after.position[solid.body];
    const Vec3 way = own_way - (centre - before.position[solid.body]);
    if (way.squaredNorm() < least_way * least_way) continue;
    if (squared_distance(centre, to - way, way) > solid.radius * solid.radius) continue;
    if (!rule_.may_touch(mover.geom, solid.geom)) continue;
    const Geom& geom = model_->geoms[solid.geom];
    BodyPose body = pose_of(after, solid.body);
    auto beyond = share_beyond(geom, body, to - way, way);
    if (!beyond || *beyond * way.norm() < least_way) continue;
    std::ranges::copy(pose_of(before, solid.body).rotation, body.rotation);
    beyond = share_beyond(geom, body, to - way, way);
    if (beyond) return Passage{mover.body, solid.geom, *beyond * way.norm()};
  }
  return std::nullopt;
}

bool PassageFinder::is_inside(const State& state, int body) const {
  const auto mover = std::ranges::lower_bound(movers_, body, {}, &Mover::body);
  if (mover == movers_.end() || mover->body != body) return false;
  const Vec3& point = state.position[body];
  const auto is_in = [&](const Solid& solid) {
    const Vec3& centre = solid.body == model::no_body ? solid.centre : state.position[solid.body];
    if ((point - centre).squaredNorm() > solid.radius * solid.radius) return false;
    if (!rule_.may_touch(mover->geom, solid.geom)) return false;
    const Geom& geom = model_->geoms[solid.geom];
    const BodyPose pose = pose_of(state, solid.body);
    // From outside a way to the point comes in, and a way back from it does not.
    const Vec3 way = Vec3::UnitX() * (3 * solid.radius);
    return enters(geom, pose, point - way, way) && !enters(geom, pose, point, -way);
  };
  return std::ranges::any_of(static_, is_in) || std::ranges::any_of(moving_, is_in);
}

}  // namespace pbmpi::stability
