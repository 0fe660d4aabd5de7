/// The axis along which two convex solids overlap least, in lanes.
///
/// The overlap along a unit vector n is F(n) = H(n) - n . d, where d is the vector from the centre of b to
/// that of a, and H the half width of both solids together, the largest n . x over the sum of their points.
/// The solids are apart if F is negative for some n; else the least F is how far a must move along n to be
/// free. Whichever n have been tried, the least F so far is an upper bound.
#pragma once

#include "solver/lanes/lanes.h"

namespace pbmpi::solver {

template <class T>
struct alignas(sizeof(typename T::V)) LeastAxis {
  using V = typename T::V;
  using L3 = Vec3L<V>;

  V overlap;  ///< [m]; huge_bound if nothing has been considered yet
  L3 normal;  ///< unit, into a

  /// (A function, since g++ compiles a constructor that it makes for the plainest instruction set.)
  PBMPI_LANES static LeastAxis none() {
    const V zero = T::broadcast(0);
    return {T::broadcast(static_cast<typename T::Scalar>(huge_bound)), {zero, zero, zero}};
  }

  PBMPI_LANES void consider(const V& other_overlap, const L3& other_normal) {
    const auto less = other_overlap < overlap;
    overlap = less ? other_overlap : overlap;
    normal.x = less ? other_normal.x : normal.x;
    normal.y = less ? other_normal.y : normal.y;
    normal.z = less ? other_normal.z : normal.z;
  }
};

/// Two of three components.
template <class V>
struct alignas(sizeof(V)) Vec2L {
  V x, y;
};

/// Seen along a straight edge a disc is an ellipse, here with its short axis along x: half axes short_share *
/// radius and radius. Finds the least overlap of the ellipse, moved by a corner, with a point at the origin,
/// among the normals of a part of one quadrant.
template <class T>
class EllipseArc {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L2 = Vec2L<V>;

  /// short_share: the cosine between the disc's axis and the line of sight.
  PBMPI_LANES EllipseArc(const V& radius, const V& short_share)
      : radius_(radius),
        share_(short_share),
        curve_(radius * (T::broadcast(1) - short_share * short_share)) {}

  /// The (unit) normal of least overlap between two directions of one quadrant, and the overlap there; a huge
  /// overlap if there is no minimum between them. (Deep inside there may also be a maximum; a minimum is then
  /// found only if it is farther from the maximum than the middle of the arc.)
  ///
  /// The unknown is the normal's place on the rim, y: in it the overlap changes smoothly even if the ellipse
  /// is thin. The equation is the quartic of a point and an ellipse (D. Eberly, "Distance from a Point to an
  /// Ellipse"), solved by regula falsi with the weights of the Illinois method.
  PBMPI_LANES V least(const L2& corner, const L2& from, const L2& to, L2& normal) const {
    const V zero = T::broadcast(0), one = T::broadcast(1), half = T::broadcast(Scalar(0.5));
    L2 a = place_of(from), b = place_of(to);
    L2 y{half * (a.x + b.x), half * (a.y + b.y)};
    const V start = slope(a, corner), middle = slope(y, corner), end = slope(b, corner);
    const auto early = (start <= zero ? middle : -one) >= zero;  // the minimum is before the middle
    const V found = early ? one : ((middle <= zero ? end : -one) >= zero ? one : zero);
    V slope_a = early ? start : middle, slope_b = early ? middle : end;
    a = {early ? a.x : y.x, early ? a.y : y.y};
    b = {early ? y.x : b.x, early ? y.y : b.y};
    V side = zero;  // -1: a has just been replaced, 1: b
    for (int i = 0; i < num_iterations; ++i) {
      const V rise = slope_b - slope_a;
      const V share = rise > zero ? -slope_a / (rise > zero ? rise : one) : half;
      y = {a.x + (b.x - a.x) * share, a.y + (b.y - a.y) * share};
      const V s = slope(y, corner);
      const auto beyond = s > zero;
      slope_a = beyond ? (side > zero ? slope_a * half : slope_a) : s;
      slope_b = beyond ? s : (side < zero ? slope_b * half : slope_b);
      a.x = beyond ? a.x : y.x;
      a.y = beyond ? a.y : y.y;
      b.x = beyond ? y.x : b.x;
      b.y = beyond ? y.y : b.y;
      side = beyond ? one : -one;
    }
    const V x = y.x, across = share_ * y.y;
    const V length = T::sqrt(x * x + across * across);
    const V inverse = one / (length > zero ? length : one);
    normal = {x * inverse, across * inverse};
    const V flat = share_ * normal.x;
    const V overlap =
        normal.x * corner.x + normal.y * corner.y + radius_ * T::sqrt(flat * flat + normal.y * normal.y);
    const V none = T::broadcast(static_cast<Scalar>(huge_bound));
    return found > zero ? (length > zero ? overlap : none) : none;
  }

 private:
  static constexpr int num_iterations = sizeof(Scalar) == 4 ? 4 : 7;

  /// Where on the rim the ellipse has this normal, as a direction of unit length.
  PBMPI_LANES L2 place_of(const L2& normal) const {
    const V x = share_ * normal.x, length = T::sqrt(x * x + normal.y * normal.y), zero = T::broadcast(0);
    const V inverse = T::broadcast(1) / (length > zero ? length : T::broadcast(1));
    return {length > zero ? x * inverse : normal.x, normal.y * inverse};
  }
  /// The overlap's derivative with respect to the angle of the normal, times a positive factor.
  PBMPI_LANES V slope(const L2& y, const L2& corner) const {
    return T::sqrt(y.x * y.x + y.y * y.y) * (y.x * corner.y - share_ * y.y * corner.x) + curve_ * y.x * y.y;
  }

  V radius_, share_, curve_;
};

}  // namespace pbmpi::solver
