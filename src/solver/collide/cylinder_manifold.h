/// The points of a cylinder that touches another solid, one pair at a time.
#pragma once

#include <algorithm>
#include <cmath>

#include "solver/collide/pair_table.h"
#include "solver/collide/spread.h"
#include "solver/collide/support_feature.h"

namespace pbmpi::solver {

/// The part of one solid's feature that lies under the other's: two points of a line, up to four of a face,
/// at least one. Points are half way between the two surfaces. A class template of T, so that each
/// instruction set has its own code.
template <class T>
class CylinderManifold {
 public:
  using Scalar = typename T::Scalar;
  using Feature = SupportFeature<T>;
  using Kind = typename Feature::Kind;
  using Point = typename Feature::Point;
  using Frame = typename Feature::Frame;
  using Beyond = typename Feature::Beyond;

  /// `normal` is the unit axis of least overlap, into a; `overlap` [m] is measured along it, negative for a
  /// gap of at most `margin`: the points are found with the solids brought together by the margin, and then
  /// parted again. Writes at most Touch::most_points points, the deepest first; returns their number.
  static int find(SolidPose<Scalar> a, const SolidPose<Scalar>& b, const Scalar* normal, Scalar overlap,
                  Scalar margin, TouchPoint* points) {
    for (int k = 0; k < 3; ++k) a.frame.centre[k] -= margin * normal[k];
    const Frame frame = frame_along(normal, b.frame.centre);
    const Feature low(a, frame, Scalar(-1)), high(b, frame, Scalar(1));
    const Scalar size = a.radius + b.radius + a.frame.half[2] + b.frame.half[2];
    CylinderManifold manifold(low, high, overlap + margin, margin, size);
    manifold.look();
    return manifold.write(frame, points);
  }

 private:
  /// A place on both features: z half way between them, and the depth of their overlap.
  struct Spot {
    Scalar x, y, z, depth;
  };
  static constexpr int most_spots = 24;
  static constexpr int num_rim_spots = 8;

  CylinderManifold(const Feature& low, const Feature& high, Scalar overlap, Scalar margin, Scalar size)
      : low_(low),
        high_(high),
        overlap_(overlap),
        margin_(margin),
        slack_(size * static_cast<Scalar>(sizeof(Scalar) == 4 ? 1e-5 : 1e-9)),
        least_way_(size * Scalar(1e-3)) {}

  static bool is_face(const Feature& feature) {
    return feature.kind() == Kind::polygon || feature.kind() == Kind::disc;
  }
  static Frame frame_along(const Scalar* normal, const Scalar* origin);

  void look();
  void add(Scalar x, Scalar y, Scalar low_z, Scalar high_z) {
    if (high_z - low_z < -slack_ || num_spots_ == most_spots) return;
    spots_[num_spots_++] = {x, y, Scalar(0.5) * (low_z + high_z), high_z - low_z};
  }
  void add_on_faces(Scalar x, Scalar y) { add(x, y, low_.height(x, y), high_.height(x, y)); }
  void line_on_line();
  void line_on_face(const Feature& line, const Feature& face, Scalar side);
  void corners_in(const Feature& polygon, const Feature& disc);
  void rim_in(const Feature& disc, const Feature& face);
  void rim_on_rim();
  void single();
  int write(const Frame& frame, TouchPoint* points);
  int choose(int* chosen) const;
  int beyond_triangle(const int* corners, Scalar turn, Scalar least) const;

  const Feature &low_, &high_;
  Scalar overlap_;    ///< [m] overlap of the solids brought together
  Scalar margin_;     ///< [m] by which they are brought together
  Scalar slack_;      ///< [m] tolerance: rounding must not part touching features
  Scalar least_way_;  ///< [m] least distance between two points
  Spot spots_[most_spots];
  int num_spots_ = 0;
};

template <class T>
typename CylinderManifold<T>::Frame CylinderManifold<T>::frame_along(const Scalar* normal,
                                                                     const Scalar* origin) {
  Frame frame;
  int least = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) < std::abs(normal[least])) least = k;
  }
  const int u = (least + 1) % 3, v = (least + 2) % 3;
  const Scalar inverse = 1 / std::sqrt(normal[u] * normal[u] + normal[v] * normal[v]);
  Scalar *x = frame.axis[0], *y = frame.axis[1], *z = frame.axis[2];
  for (int k = 0; k < 3; ++k) {
    frame.origin[k] = origin[k];
    z[k] = normal[k];
  }
  x[least] = 0;
  x[u] = -normal[v] * inverse;
  x[v] = normal[u] * inverse;
  y[0] = z[1] * x[2] - z[2] * x[1];
  y[1] = z[2] * x[0] - z[0] * x[2];
  y[2] = z[0] * x[1] - z[1] * x[0];
  return frame;
}

template <class T>
void CylinderManifold<T>::look() {
  if (low_.kind() == Kind::point || high_.kind() == Kind::point) {
    single();
  } else if (is_face(low_) && is_face(high_)) {
    if (low_.kind() == Kind::polygon) corners_in(low_, high_);
    if (high_.kind() == Kind::polygon) corners_in(high_, low_);
    if (low_.kind() == Kind::disc) rim_in(low_, high_);
    if (high_.kind() == Kind::disc) rim_in(high_, low_);
    if (low_.kind() == Kind::disc && high_.kind() == Kind::disc) rim_on_rim();
  } else if (is_face(low_)) {
    line_on_face(high_, low_, Scalar(1));
  } else if (is_face(high_)) {
    line_on_face(low_, high_, Scalar(-1));
  } else {
    line_on_line();
  }
  // Touching solids keep a spot where they touch, however many spots there are with a gap within the margin.
  const bool all_are_gaps =
      std::all_of(spots_, spots_ + num_spots_, [&](const Spot& spot) { return spot.depth < margin_; });
  if (num_spots_ == 0 || (all_are_gaps && overlap_ > margin_ && num_spots_ < most_spots)) single();
}

/// Adds one spot, where a corner or a rim is, or else (when rounding has left nothing of two faces) half way
/// between both.
template <class T>
void CylinderManifold<T>::single() {
  const Point &low = low_.farthest(), &high = high_.farthest();
  const Scalar half = Scalar(0.5) * overlap_;
  if (low_.kind() == Kind::point && high_.kind() == Kind::point) {
    spots_[num_spots_++] = {Scalar(0.5) * (low.x + high.x), Scalar(0.5) * (low.y + high.y),
                            Scalar(0.5) * (low.z + high.z), overlap_};
  } else if (high_.kind() == Kind::point) {
    spots_[num_spots_++] = {high.x, high.y, high.z - half, overlap_};
  } else {
    spots_[num_spots_++] = {low.x, low.y, low.z + half, overlap_};
  }
}

/// Crossing lines touch at a point; nearly parallel lines touch along the stretch where they lie side by
/// side, as long as they are no farther apart than their overlap.
template <class T>
void CylinderManifold<T>::line_on_line() {
  const Point &p = low_.point(0), &q = high_.point(0);
  const Point u{low_.point(1).x - p.x, low_.point(1).y - p.y, low_.point(1).z - p.z};
  const Point v{high_.point(1).x - q.x, high_.point(1).y - q.y, high_.point(1).z - q.z};
  const Scalar uu = u.x * u.x + u.y * u.y, vv = v.x * v.x + v.y * v.y, uv = u.x * v.x + u.y * v.y;
  const Scalar apart_x = q.x - p.x, apart_y = q.y - p.y;
  const Scalar start = (apart_x * u.x + apart_y * u.y) / uu, end = start + uv / uu;  // of high, along low
  Scalar first = std::max(Scalar(0), std::min(start, end)), last = std::min(Scalar(1), std::max(start, end));
  const auto spot_at = [&](Scalar s) {
    const Scalar along = ((u.x * s - apart_x) * v.x + (u.y * s - apart_y) * v.y) / vv;
    const Scalar t = std::min(std::max(along, Scalar(0)), Scalar(1));
    const Scalar low_z = p.z + u.z * s, high_z = q.z + v.z * t;
    return Spot{Scalar(0.5) * (p.x + u.x * s + q.x + v.x * t), Scalar(0.5) * (p.y + u.y * s + q.y + v.y * t),
                Scalar(0.5) * (low_z + high_z), high_z - low_z};
  };
  // The ends of touching lines are where they touch: a gap within the margin must not draw the ends apart.
  const Scalar reach = overlap_ > margin_ ? overlap_ - margin_ : overlap_;
  const Scalar crossed = u.x * v.y - u.y * v.x, length = std::sqrt(uu);
  const Scalar offset = std::abs(crossed) / std::sqrt(vv);  // from one end of low to the other
  Scalar crossing = Scalar(0.5) * (first + last), least_way = least_way_;
  if (offset > reach) {
    crossing = (apart_x * v.y - apart_y * v.x) / crossed;
    least_way = 4 * reach;
  }
  const Scalar touching = std::min(std::max(crossing, first), std::max(first, last));
  if (offset > reach) {
    first = std::max(first, crossing - reach / offset);
    last = std::min(last, crossing + reach / offset);
  }
  if ((last - first) * length > least_way) {
    for (const Scalar s : {first, last}) {
      const Spot spot = spot_at(s);
      if (spot.depth >= -slack_) spots_[num_spots_++] = spot;
    }
    return;
  }
  spots_[num_spots_] = spot_at(touching);
  spots_[num_spots_++].depth = overlap_;
}

/// `side`: 1 if the line is b's, -1 if it is a's.
template <class T>
void CylinderManifold<T>::line_on_face(const Feature& line, const Feature& face, Scalar side) {
  const Point& p = line.point(0);
  const Point way{line.point(1).x - p.x, line.point(1).y - p.y, line.point(1).z - p.z};
  Scalar first = 0, last = 1;
  face.clip(p, way, slack_, first, last);
  if (last < first) return;
  const auto add_at = [&](Scalar s) {
    const Scalar x = p.x + way.x * s, y = p.y + way.y * s, z = p.z + way.z * s, other = face.height(x, y);
    add(x, y, side > 0 ? other : z, side > 0 ? z : other);
  };
  add_at(first);
  add_at(last);
}

/// Adds the polygon's corners inside the disc, and the points where its edges cross the rim.
template <class T>
void CylinderManifold<T>::corners_in(const Feature& polygon, const Feature& disc) {
  for (int i = 0; i < polygon.num_points(); ++i) {
    const Point &p = polygon.point(i), &next = polygon.point((i + 1) % polygon.num_points());
    const Point way{next.x - p.x, next.y - p.y, next.z - p.z};
    Scalar first = 0, last = 1;
    disc.clip(p, way, slack_, first, last);
    if (last < first) continue;
    add_on_faces(p.x + way.x * first, p.y + way.y * first);
    // The next edge begins at this one's end.
    if (last < 1 && last > first) add_on_faces(p.x + way.x * last, p.y + way.y * last);
  }
}

/// Adds those of eight places on the rim, the first where the overlap is deepest, that lie within the face.
template <class T>
void CylinderManifold<T>::rim_in(const Feature& disc, const Feature& face) {
  const Scalar half_root = Scalar(0.70710678118654752440);
  Scalar x = high_.slope_x() - low_.slope_x(), y = high_.slope_y() - low_.slope_y();
  const Scalar tilt = std::sqrt(x * x + y * y);
  x = tilt < Scalar(1e-4) ? Scalar(1) : x / tilt;
  y = tilt < Scalar(1e-4) ? Scalar(0) : y / tilt;
  for (int i = 0; i < num_rim_spots; ++i) {
    // A tilted disc is an ellipse; this is its rim in this direction.
    const Scalar rise = disc.slope_x() * x + disc.slope_y() * y;
    const Scalar reach = disc.radius() / std::sqrt(1 + rise * rise);
    const Scalar at_x = disc.point(0).x + x * reach, at_y = disc.point(0).y + y * reach;
    if (face.contains(at_x, at_y, slack_)) add_on_faces(at_x, at_y);
    const Scalar turned = half_root * (x - y);
    y = half_root * (x + y);
    x = turned;
  }
}

/// Adds the points where two rims cross, found first as if neither disc were tilted, then by Newton's method.
template <class T>
void CylinderManifold<T>::rim_on_rim() {
  const Point &p = low_.point(0), &q = high_.point(0);
  const Scalar dx = q.x - p.x, dy = q.y - p.y, square = dx * dx + dy * dy;
  const Scalar r = low_.radius(), s = high_.radius();
  if (square <= least_way_ * least_way_) return;
  const Scalar share = Scalar(0.5) * (1 + (r * r - s * s) / square);
  // Rims that touch at one place touch on the line of centres.
  const Scalar across = std::sqrt(std::max(r * r / square - share * share, Scalar(0)));
  for (const Scalar side : {across, -across}) {
    Scalar x = p.x + dx * share - dy * side, y = p.y + dy * share + dx * side;
    for (int i = 0; i < 3; ++i) {
      const Beyond low = low_.beyond_rim(x, y), high = high_.beyond_rim(x, y);
      const Scalar det = low.by_x * high.by_y - low.by_y * high.by_x;
      if (std::abs(det) < Scalar(0.1) * r * s) break;
      x -= (low.value * high.by_y - high.value * low.by_y) / det;
      y -= (high.value * low.by_x - low.value * high.by_x) / det;
    }
    if (low_.contains(x, y, slack_) && high_.contains(x, y, slack_)) add_on_faces(x, y);
  }
}

/// Chooses the deepest spot, the one farthest from it, and the farthest on either side of the line between
/// them; if all lie on one side, also the one farthest beyond the triangle of these three.
template <class T>
int CylinderManifold<T>::choose(int* chosen) const {
  int deepest = 0;
  for (int i = 1; i < num_spots_; ++i) {
    if (spots_[i].depth > spots_[deepest].depth + slack_) deepest = i;
  }
  const Spread<T> spread = Spread<T>::from(deepest, num_spots_, [&](int i) {
    return typename Spread<T>::Place{spots_[i].x, spots_[i].y};
  });
  const Scalar near = spread.square * Scalar(1e-3);  // a point nearer to the line than this adds nothing
  int kept = 0;
  chosen[kept++] = deepest;
  if (spread.square > least_way_ * least_way_) chosen[kept++] = spread.farthest;
  if (spread.area_left > near) chosen[kept++] = spread.left;
  if (-spread.area_right > near) chosen[kept++] = spread.right;
  if (kept == 3) {
    const int fourth = beyond_triangle(chosen, spread.area_left > near ? Scalar(1) : Scalar(-1), near);
    if (fourth >= 0) chosen[kept++] = fourth;
  }
  return kept;
}

/// The spot farthest beyond the two edges of a triangle that meet in its third corner, -1 if there is none.
/// `turn`: 1 if its corners go round counterclockwise.
template <class T>
int CylinderManifold<T>::beyond_triangle(const int* corners, Scalar turn, Scalar least) const {
  int farthest = -1;
  for (int edge = 0; edge < 2; ++edge) {
    const Spot& from = spots_[edge == 0 ? corners[1] : corners[2]];
    const Spot& to = spots_[edge == 0 ? corners[2] : corners[0]];
    for (int i = 0; i < num_spots_; ++i) {
      const Scalar area =
          turn * ((to.y - from.y) * (spots_[i].x - from.x) - (to.x - from.x) * (spots_[i].y - from.y));
      if (area > least) {
        least = area;
        farthest = i;
      }
    }
  }
  return farthest;
}

template <class T>
int CylinderManifold<T>::write(const Frame& frame, TouchPoint* points) {
  int chosen[Touch::most_points];
  const int kept = choose(chosen);
  for (int i = 0; i < kept; ++i) {
    const Spot& spot = spots_[chosen[i]];
    for (int k = 0; k < 3; ++k) {
      const Scalar z = spot.z + Scalar(0.5) * margin_;
      points[i].position[k] =
          frame.origin[k] + spot.x * frame.axis[0][k] + spot.y * frame.axis[1][k] + z * frame.axis[2][k];
      points[i].normal[k] = frame.axis[2][k];
    }
    points[i].depth = std::min(std::max(spot.depth, Scalar(0)), overlap_) - margin_;
  }
  return kept;
}

}  // namespace pbmpi::solver
