/// The part of a solid that faces a direction, and touches another solid that comes from there.
#pragma once

#include <algorithm>
#include <cmath>

#include "model/model.h"
#include "solver/collide/box_lanes.h"

namespace pbmpi::solver {

/// One solid of one pair.
template <class Scalar>
struct SolidPose {
  BoxPose<Scalar> frame;  ///< centre, own axes, and half sides or (z) half length
  Scalar radius;          ///< 0 for a box
  model::Shape shape;
};

/// A corner or a place on a rim, a straight edge or line of a round side, a box's face, or a cylinder's end,
/// in coordinates x and y across the direction, and z along it. Faces, ends and lines are nearly across the
/// direction: within the angle whose sine is `most_tilt`. A class template of T, so that each instruction set
/// has its own code.
template <class T>
class SupportFeature {
 public:
  using Scalar = typename T::Scalar;
  enum class Kind { point, line, polygon, disc };
  static constexpr Scalar most_tilt = Scalar(0.25);

  struct Point {
    Scalar x, y, z;
  };
  /// Unit vectors; z is the direction.
  struct Frame {
    Scalar origin[3], axis[3][3];
    Point to_local(const Scalar* world) const {
      Scalar p[3];
      for (int k = 0; k < 3; ++k) p[k] = world[k] - origin[k];
      return turned(p);
    }
    Point turned(const Scalar* v) const { return {dot3(v, axis[0]), dot3(v, axis[1]), dot3(v, axis[2])}; }
  };

  /// The part of `solid` that lies farthest along `side` (1 or -1) times the frame's z.
  SupportFeature(const SolidPose<Scalar>& solid, const Frame& frame, Scalar side) {
    if (solid.shape == model::Shape::box) {
      set_box(solid.frame, frame, side);
    } else {
      set_round(solid, frame, side);
    }
  }

  Kind kind() const { return kind_; }
  int num_points() const { return num_points_; }
  /// Ends of a line, corners of a polygon in order around it, centre of a disc.
  const Point& point(int i) const { return points_[i]; }
  Scalar radius() const { return radius_; }
  /// The farthest point, or one of them if there are many.
  const Point& farthest() const { return farthest_; }
  /// z of a polygon's or a disc's plane.
  Scalar height(Scalar x, Scalar y) const {
    return points_[0].z + slope_x_ * (x - points_[0].x) + slope_y_ * (y - points_[0].y);
  }
  Scalar slope_x() const { return slope_x_; }
  Scalar slope_y() const { return slope_y_; }
  /// Does a place in the plane belong to the polygon or disc, give or take the distance `slack`?
  bool contains(Scalar x, Scalar y, Scalar slack) const {
    return kind_ == Kind::disc ? disc_contains(x, y, slack) : polygon_contains(x, y, slack);
  }
  /// Half the amount by which the squared distance of a place from a disc's centre exceeds that of its rim,
  /// and its derivatives.
  struct Beyond {
    Scalar value, by_x, by_y;
  };
  Beyond beyond_rim(Scalar x, Scalar y) const {
    const Scalar dx = x - points_[0].x, dy = y - points_[0].y, dz = slope_x_ * dx + slope_y_ * dy;
    return {Scalar(0.5) * (dx * dx + dy * dy + dz * dz - radius_ * radius_), dx + slope_x_ * dz,
            dy + slope_y_ * dz};
  }
  /// Narrows [first, last] to the part of from + s way inside the polygon or disc, give or take the distance
  /// `slack`.
  void clip(const Point& from, const Point& way, Scalar slack, Scalar& first, Scalar& last) const {
    if (kind_ == Kind::disc) {
      clip_by_disc(from, way, slack, first, last);
    } else {
      clip_by_polygon(from, way, slack, first, last);
    }
  }

 private:
  static Scalar dot3(const Scalar* x, const Scalar* y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
  static Point along(const Point& p, const Point& way, Scalar s) {
    return {p.x + way.x * s, p.y + way.y * s, p.z + way.z * s};
  }
  static Scalar square(Scalar x) { return x * x; }

  void set_box(const BoxPose<Scalar>& box, const Frame& frame, Scalar side);
  void set_round(const SolidPose<Scalar>& solid, const Frame& frame, Scalar side);
  void set_slope(const Point& normal) {
    slope_x_ = -normal.x / normal.z;
    slope_y_ = -normal.y / normal.z;
  }
  bool disc_contains(Scalar x, Scalar y, Scalar slack) const {
    const Scalar dx = x - points_[0].x, dy = y - points_[0].y;
    return square(dx) + square(dy) + square(slope_x_ * dx + slope_y_ * dy) <= square(radius_ + slack);
  }
  /// How far a place lies inside the polygon's edge i [m].
  Scalar inside_of(int i, Scalar x, Scalar y) const {
    const Point &p = points_[i], &q = points_[(i + 1) % num_points_];
    const Scalar ex = q.x - p.x, ey = q.y - p.y;
    return winding_ * (ex * (y - p.y) - ey * (x - p.x)) / std::sqrt(ex * ex + ey * ey);
  }
  bool polygon_contains(Scalar x, Scalar y, Scalar slack) const {
    for (int i = 0; i < num_points_; ++i) {
      if (inside_of(i, x, y) < -slack) return false;
    }
    return true;
  }
  void clip_by_polygon(const Point& from, const Point& way, Scalar slack, Scalar& first, Scalar& last) const;
  void clip_by_disc(const Point& from, const Point& way, Scalar slack, Scalar& first, Scalar& last) const;

  Kind kind_ = Kind::point;
  int num_points_ = 1;
  Point points_[4]{}, farthest_{};
  Scalar radius_ = 0, slope_x_ = 0, slope_y_ = 0;
  Scalar winding_ = 1;  ///< -1 if a polygon's corners go round clockwise
};

template <class T>
void SupportFeature<T>::set_box(const BoxPose<Scalar>& box, const Frame& frame, Scalar side) {
  Point edge[3];
  Point corner = frame.to_local(box.centre);
  int steepest = 0, flattest = 0;
  for (int k = 0; k < 3; ++k) {
    edge[k] = frame.turned(box.axis[k]);
    if (edge[k].z * side < 0) edge[k] = {-edge[k].x, -edge[k].y, -edge[k].z};
    corner = along(corner, edge[k], box.half[k]);
    if (std::abs(edge[k].z) > std::abs(edge[steepest].z)) steepest = k;
    if (std::abs(edge[k].z) < std::abs(edge[flattest].z)) flattest = k;
  }
  farthest_ = points_[0] = corner;
  const int u = (steepest + 1) % 3, v = (steepest + 2) % 3;
  const Scalar tilt2 = square(edge[u].z) + square(edge[v].z);
  if (tilt2 <= square(most_tilt)) {
    kind_ = Kind::polygon;
    num_points_ = 4;
    points_[1] = along(corner, edge[u], -2 * box.half[u]);
    points_[2] = along(points_[1], edge[v], -2 * box.half[v]);
    points_[3] = along(corner, edge[v], -2 * box.half[v]);
    set_slope(edge[steepest]);
    winding_ = edge[u].x * edge[v].y - edge[u].y * edge[v].x < 0 ? Scalar(-1) : Scalar(1);
  } else if (std::abs(edge[flattest].z) <= most_tilt) {
    kind_ = Kind::line;
    num_points_ = 2;
    points_[1] = along(corner, edge[flattest], -2 * box.half[flattest]);
  }
}

template <class T>
void SupportFeature<T>::set_round(const SolidPose<Scalar>& solid, const Frame& frame, Scalar side) {
  const BoxPose<Scalar>& pose = solid.frame;
  Point axis = frame.turned(pose.axis[2]);
  if (axis.z * side < 0) axis = {-axis.x, -axis.y, -axis.z};
  const Scalar sine = std::sqrt(square(axis.x) + square(axis.y));
  const Point centre = frame.to_local(pose.centre);
  Point out{0, 0, side};  // from the axis to the line of the side
  if (solid.shape == model::Shape::cylinder) {
    const Scalar share = sine > 0 ? std::abs(axis.z) / sine : Scalar(0);  // of the axis, across it
    out = {-axis.x * share, -axis.y * share, side * sine};
  }
  points_[0] = along(along(centre, axis, pose.half[2]), out, solid.radius);
  farthest_ = points_[0];
  if (std::abs(axis.z) <= most_tilt) {
    kind_ = Kind::line;
    num_points_ = 2;
    points_[1] = along(points_[0], axis, -2 * pose.half[2]);
  } else if (solid.shape == model::Shape::cylinder && sine <= most_tilt) {
    kind_ = Kind::disc;
    points_[0] = along(centre, axis, pose.half[2]);
    radius_ = solid.radius;
    set_slope(axis);
  }
}

template <class T>
void SupportFeature<T>::clip_by_polygon(const Point& from, const Point& way, Scalar slack, Scalar& first,
                                        Scalar& last) const {
  for (int i = 0; i < num_points_; ++i) {
    const Scalar inside = inside_of(i, from.x, from.y);
    const Scalar at = inside + slack, rise = inside_of(i, from.x + way.x, from.y + way.y) - inside;
    if (rise > 0) {
      first = std::max(first, -at / rise);
    } else if (rise < 0) {
      last = std::min(last, -at / rise);
    } else if (at < 0) {
      last = first - 1;
    }
  }
}

template <class T>
void SupportFeature<T>::clip_by_disc(const Point& from, const Point& way, Scalar slack, Scalar& first,
                                     Scalar& last) const {
  const Scalar px = from.x - points_[0].x, py = from.y - points_[0].y;
  const Scalar pz = slope_x_ * px + slope_y_ * py, wz = slope_x_ * way.x + slope_y_ * way.y;
  const Scalar a = square(way.x) + square(way.y) + square(wz);
  const Scalar b = px * way.x + py * way.y + pz * wz;
  const Scalar c = square(px) + square(py) + square(pz) - square(radius_ + slack);
  const Scalar root2 = b * b - a * c;
  if (a <= 0 || root2 < 0) {
    last = first - 1;
    return;
  }
  const Scalar root = std::sqrt(root2);
  first = std::max(first, (-b - root) / a);
  last = std::min(last, (-b + root) / a);
}

}  // namespace pbmpi::solver
