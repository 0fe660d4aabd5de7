/// The axis along which a cylinder and another solid overlap least, in lanes.
///
/// A cylinder is the sum of a segment and a disc, and the other solids are similar sums. If a point is
/// outside the sum of two solids, a normal of one of the sum's smooth pieces shows it (R. T. Rockafellar,
/// "Convex Analysis", theorem 18.8); if it is inside, the nearest point of the surface is on such a piece.
/// These pieces are flat faces; surfaces that a straight edge sweeps along a disc's rim, whose normals are
/// across the edge (EllipseArc); and with two discs the surface that one rim sweeps along the other
/// (rim_on_rim).
#pragma once

#include "solver/collide/geom_lanes.h"
#include "solver/collide/least_axis.h"
#include "solver/lanes/plane_space.h"

namespace pbmpi::solver {

/// a is the cylinder. Among equal axes a face wins.
template <class T>
class CylinderAxes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L2 = Vec2L<V>;
  using L3 = Vec3L<V>;
  using Side = GeomSide<T>;

  /// The least axis of a pair; its overlap is negative if the two are apart.
  static void with_box(const Side& a, const Side& b, LeastAxis<T>& least);
  static void with_capsule(const Side& a, const Side& b, LeastAxis<T>& least);
  static void with_cylinder(const Side& a, const Side& b, LeastAxis<T>& least);

 private:
  /// The segment and the disc of a cylinder.
  struct alignas(sizeof(V)) Cylinder {
    L3 axis;
    V half, radius;

    PBMPI_LANES explicit Cylinder(const Side& side)
        : axis(side.axis(2)), half(side.half(2)), radius(side.radius()) {}
    /// Half its width along n. The rim's share comes from the cross product, since 1 - cosine^2 has no digits
    /// left near the axis.
    PBMPI_LANES V width(const L3& n) const {
      const L3 rim = cross(axis, n);
      return half * T::abs(dot(axis, n)) + radius * T::sqrt(dot(rim, rim));
    }
  };

  PBMPI_LANES static V zero() { return T::broadcast(0); }
  PBMPI_LANES static V one() { return T::broadcast(1); }
  PBMPI_LANES static V huge() { return T::broadcast(static_cast<Scalar>(huge_bound)); }
  /// Sines below this are rounding noise.
  PBMPI_LANES static V tiny() { return T::broadcast(static_cast<Scalar>(sizeof(Scalar) == 4 ? 1e-3 : 1e-7)); }
  PBMPI_LANES static V sign_of(const V& x) { return x < zero() ? -one() : one(); }
  /// x or -x, whichever points along d.
  PBMPI_LANES static L3 towards(const L3& x, const L3& d) { return x * sign_of(dot(x, d)); }
  /// The unit vector along x; writes the length of x to `length`.
  PBMPI_LANES static L3 unit(const L3& x, V& length) {
    length = T::sqrt(dot(x, x));
    return x * (one() / (length > zero() ? length : one()));
  }
  /// The lesser of both. A face wins unless another axis has less overlap by more than rounding.
  PBMPI_LANES static void join(const LeastAxis<T>& faces, const LeastAxis<T>& others, LeastAxis<T>& least) {
    least = faces;
    const V rounding = T::broadcast(static_cast<Scalar>(1e-4)) * T::abs(others.overlap);
    const auto other = others.overlap + rounding < faces.overlap;
    least.consider(other ? others.overlap : huge(), others.normal);
  }

  static void edge_on_rim(const Cylinder& a, const Side& b, const L3& d, int edge, LeastAxis<T>& others);
  static void side_on_corners(const Cylinder& a, const Side& b, const L3& d, LeastAxis<T>& others);
  static void side_on_rim(const L3& edge, const V& added, const Cylinder& disc, const L3& d,
                          LeastAxis<T>& others);
  static void rim_on_rim(const Cylinder& a, const Cylinder& b, const L3& d, LeastAxis<T>& others);
  static void near_cap(const Cylinder& cap, const Cylinder& other, const L3& d, LeastAxis<T>& best);
  static void capsule_outside(const Cylinder& a, const L3& direction, const V& half, const V& radius,
                              const L3& d, LeastAxis<T>& others);
};

template <class T>
void CylinderAxes<T>::with_box(const Side& side_a, const Side& b, LeastAxis<T>& least) {
  const Cylinder a(side_a);
  const L3 d = side_a.centre() - b.centre();
  L3 axis[3];
  V half[3];
  for (int k = 0; k < 3; ++k) {
    axis[k] = b.axis(k);
    half[k] = b.half(k);
  }
  const auto overlap = [&](const L3& n) {
    V sum = a.width(n) - dot(n, d);
    for (int k = 0; k < 3; ++k) sum += half[k] * T::abs(dot(axis[k], n));
    return sum;
  };
  LeastAxis<T> faces = LeastAxis<T>::none(), others = LeastAxis<T>::none();
  for (int k = 0; k < 3; ++k) {
    const L3 n = towards(axis[k], d);
    faces.consider(overlap(n), n);
  }
  const L3 cap = towards(a.axis, d);
  faces.consider(overlap(cap), cap);
  for (int k = 0; k < 3; ++k) {
    V sine;
    const L3 n = towards(unit(cross(a.axis, axis[k]), sine), d);
    others.consider(sine > tiny() ? overlap(n) : huge(), n);
  }
  if (T::any(T::min(faces.overlap, others.overlap) >= side_a.least_depth() ? one() : zero())) {
    side_on_corners(a, b, d, others);
    for (int k = 0; k < 3; ++k) edge_on_rim(a, b, d, k, others);
  }
  join(faces, others, least);
}

/// Considers the normal between the cylinder's side and the box's corner nearest to its axis.
template <class T>
void CylinderAxes<T>::side_on_corners(const Cylinder& a, const Side& b, const L3& d, LeastAxis<T>& others) {
  L3 edge[3];
  for (int k = 0; k < 3; ++k) edge[k] = b.axis(k) * b.half(k);
  V nearest = huge();
  L3 way{};
  for (int corner = 0; corner < 8; ++corner) {
    L3 out = d;
    for (int k = 0; k < 3; ++k) out = (corner >> k & 1) != 0 ? out - edge[k] : out + edge[k];
    out = out - a.axis * dot(a.axis, out);
    const V square = dot(out, out);
    const auto nearer = square < nearest;
    nearest = nearer ? square : nearest;
    way = {nearer ? out.x : way.x, nearer ? out.y : way.y, nearer ? out.z : way.z};
  }
  V length;
  const L3 n = unit(way, length);
  V overlap = a.radius - dot(n, d);
  for (int k = 0; k < 3; ++k) overlap += T::abs(dot(edge[k], n));
  others.consider(length > zero() ? overlap : huge(), n);
}

/// Considers normals across edge k of the box: seen along it the box is a rectangle with the sides p and q,
/// the disc an ellipse, and the cylinder's segment lies along the ellipse's short axis. The supporting corner
/// stays the same between successive directions of the rectangle's sides, the ellipse's axes, and their
/// opposites.
template <class T>
void CylinderAxes<T>::edge_on_rim(const Cylinder& a, const Side& b, const L3& d, int k,
                                  LeastAxis<T>& others) {
  const L3 edge = b.axis(k), own_p = b.axis((k + 1) % 3), own_q = b.axis((k + 2) % 3);
  const V half_p = b.half((k + 1) % 3), half_q = b.half((k + 2) % 3);
  // With these signs the short axis lies between p and q.
  const L3 p = own_p * sign_of(dot(own_p, a.axis)), q = own_q * sign_of(dot(own_q, a.axis));
  const V along_p = dot(p, a.axis), along_q = dot(q, a.axis);
  const V sine = T::sqrt(along_p * along_p + along_q * along_q);
  const auto turned = sine > tiny();
  const V inverse = one() / (turned ? sine : one());
  const V wx = turned ? along_p * inverse : one(), wy = turned ? along_q * inverse : zero();
  const L3 short_axis = p * wx + q * wy, long_axis = q * wx - p * wy;
  const V segment = turned ? a.half * sine : zero();
  const EllipseArc<T> ellipse(a.radius, turned ? T::min(T::abs(dot(edge, a.axis)), one()) : one());
  const V d_x = dot(d, short_axis), d_y = dot(d, long_axis);
  // p, the short axis, q, the long axis and -p, in the order of their angles.
  const L2 places[5] = {{wx, -wy}, {one(), zero()}, {wy, wx}, {zero(), one()}, {-wx, wy}};
  for (int arc = 0; arc < 4; ++arc) {
    const L2 &from = places[arc], &to = places[arc + 1];
    const V sign_p = arc < 2 ? half_p : -half_p, sign_w = arc < 3 ? segment : -segment;
    const V side = sign_of((from.x + to.x) * d_x + (from.y + to.y) * d_y);
    const L2 corner{sign_p * wx + half_q * wy + sign_w - side * d_x, half_q * wx - sign_p * wy - side * d_y};
    L2 n;
    const V overlap = ellipse.least(corner, from, to, n);
    others.consider(overlap, (short_axis * n.x + long_axis * n.y) * side);
  }
}

/// Considers normals across an edge with nothing but a radius `added` [m] around it, such as a cylinder's
/// side: the ellipse and the segment of the other solid are symmetric, so that the quadrant in which d lies
/// has the least overlap.
template <class T>
void CylinderAxes<T>::side_on_rim(const L3& edge, const V& added, const Cylinder& disc, const L3& d,
                                  LeastAxis<T>& others) {
  V sine;
  const L3 flat = unit(disc.axis - edge * dot(edge, disc.axis), sine);
  const auto turned = sine > tiny();
  L3 any, other;
  plane_space<T>(edge, any, other);
  const L3 axis{turned ? flat.x : any.x, turned ? flat.y : any.y, turned ? flat.z : any.z};
  const L3 short_axis = towards(axis, d), long_axis = towards(cross(edge, axis), d);
  const EllipseArc<T> ellipse(disc.radius, turned ? T::min(T::abs(dot(edge, disc.axis)), one()) : one());
  const L2 corner{(turned ? disc.half * sine : zero()) - dot(short_axis, d), -dot(long_axis, d)};
  L2 n;
  const V overlap = ellipse.least(corner, {one(), zero()}, {zero(), one()}, n);
  others.consider(overlap + added, short_axis * n.x + long_axis * n.y);
}

template <class T>
void CylinderAxes<T>::with_capsule(const Side& side_a, const Side& b, LeastAxis<T>& least) {
  const Cylinder a(side_a);
  const L3 d = side_a.centre() - b.centre(), direction = b.axis(2);
  const V half = b.half(2), radius = b.radius();
  const auto overlap = [&](const L3& n) {
    return a.width(n) + half * T::abs(dot(direction, n)) + radius - dot(n, d);
  };
  const L3 cap = towards(a.axis, d);
  least.consider(overlap(cap), cap);
  V sine;
  const L3 crossed = towards(unit(cross(a.axis, direction), sine), d);
  least.consider(sine > tiny() ? overlap(crossed) : huge(), crossed);
  if (!T::any(least.overlap >= side_a.least_depth() ? one() : zero())) return;
  // Across the cylinder's side: the segment's nearest point to its axis, seen along it.
  const L3 seen_d = d - a.axis * dot(a.axis, d), seen = direction - a.axis * dot(a.axis, direction);
  const V square = dot(seen, seen);
  const V t = T::min(T::max(dot(seen, seen_d) / (square > zero() ? square : one()), -half), half);
  V length;
  const L3 across = unit(seen_d - seen * t, length);
  least.consider(length > zero() ? overlap(across) : huge(), across);
  side_on_rim(direction, radius, a, d, least);
  capsule_outside(a, direction, half, radius, d, least);
}

/// Considers the normal from the cylinder's nearest point to the segment, if they are apart. Half the
/// derivative of the squared distance rises along the segment; regula falsi (Illinois method) finds its root.
template <class T>
void CylinderAxes<T>::capsule_outside(const Cylinder& a, const L3& direction, const V& half, const V& radius,
                                      const L3& d, LeastAxis<T>& others) {
  constexpr int num_iterations = sizeof(Scalar) == 4 ? 8 : 12;
  const V along_d = dot(a.axis, d), along = dot(a.axis, direction);
  const L3 start = a.axis * along_d - d, way = direction - a.axis * along;  // across the cylinder's axis
  const V square = dot(way, way), mixed = dot(way, start), start_square = dot(start, start);
  const V weight_half = T::broadcast(Scalar(0.5));
  const auto slope = [&](const V& t) {
    const V distance = T::sqrt(T::max(start_square + t * (mixed + mixed + t * square), zero()));
    const V height = t * along - along_d;
    const V over = height - T::min(T::max(height, -a.half), a.half);
    const V share = distance > a.radius ? one() - a.radius / (distance > zero() ? distance : one()) : zero();
    return share * (mixed + t * square) + over * along;
  };
  V lo = -half, hi = half, slope_lo = slope(lo), slope_hi = slope(hi), t = lo, side = zero();
  const auto at_lo = slope_lo >= zero();
  const auto at_hi = slope_hi <= zero();
  for (int i = 0; i < num_iterations; ++i) {
    const V rise = slope_hi - slope_lo;
    const V share = rise > zero() ? -slope_lo / (rise > zero() ? rise : one()) : weight_half;
    t = lo + (hi - lo) * share;
    const V s = slope(t);
    const auto beyond = s > zero();
    slope_lo = beyond ? (side > zero() ? slope_lo * weight_half : slope_lo) : s;
    slope_hi = beyond ? s : (side < zero() ? slope_hi * weight_half : slope_hi);
    lo = beyond ? lo : t;
    hi = beyond ? t : hi;
    side = beyond ? one() : -one();
  }
  t = at_lo ? -half : (at_hi ? half : t);
  const L3 out = start + way * t;
  const V distance = T::sqrt(dot(out, out)), height = t * along - along_d;
  const V share = distance > a.radius ? one() - a.radius / (distance > zero() ? distance : one()) : zero();
  const V over = height - T::min(T::max(height, -a.half), a.half);
  V gap;
  const L3 n = -unit(out * share + a.axis * over, gap);
  const V overlap = a.width(n) + half * T::abs(dot(direction, n)) + radius - dot(n, d);
  others.consider(gap > zero() ? overlap : huge(), n);
}

template <class T>
void CylinderAxes<T>::with_cylinder(const Side& side_a, const Side& side_b, LeastAxis<T>& least) {
  const Cylinder a(side_a), b(side_b);
  const L3 d = side_a.centre() - side_b.centre();
  const auto overlap = [&](const L3& n) { return a.width(n) + b.width(n) - dot(n, d); };
  LeastAxis<T> faces = LeastAxis<T>::none(), others = LeastAxis<T>::none();
  for (const L3& axis : {a.axis, b.axis}) {
    const L3 n = towards(axis, d);
    faces.consider(overlap(n), n);
  }
  V sine;
  const L3 crossed = towards(unit(cross(a.axis, b.axis), sine), d);
  others.consider(sine > tiny() ? overlap(crossed) : huge(), crossed);
  if (T::any(T::min(faces.overlap, others.overlap) >= side_a.least_depth() ? one() : zero())) {
    side_on_rim(a.axis, a.radius, b, d, others);
    side_on_rim(b.axis, b.radius, a, d, others);
    rim_on_rim(a, b, d, others);
  }
  join(faces, others, least);
}

/// Considers normals near the cap's own, tilted towards where the other solid comes nearest to it.
template <class T>
void CylinderAxes<T>::near_cap(const Cylinder& cap, const Cylinder& other, const L3& d, LeastAxis<T>& best) {
  const L3 n = towards(cap.axis, d), side = other.axis - n * dot(n, other.axis);
  V sine, length;
  const L3 rim = -unit(side, sine) * dot(n, other.axis);  // component across n of the other's rim point
  const L3 point = side * (other.half * sign_of(dot(n, other.axis))) + rim * other.radius;
  const L3 out = unit(point - (d - n * dot(n, d)), length);
  for (const double tilt : {0.02, 0.1, 0.3}) {
    const L3 tilted = unit(n - out * T::broadcast(static_cast<Scalar>(tilt)), length);
    best.consider(cap.width(tilted) + other.width(tilted) - dot(tilted, d), tilted);
  }
}

/// Rim against rim: Newton's method on the sphere of normals, from the best of some normals off the planes
/// where other features meet. Each rim's part of the Hessian is how far its support point moves along its
/// tangent.
template <class T>
void CylinderAxes<T>::rim_on_rim(const Cylinder& a, const Cylinder& b, const L3& d, LeastAxis<T>& others) {
  constexpr int num_iterations = sizeof(Scalar) == 4 ? 6 : 10;
  V sine;
  const L3 crossed = unit(cross(a.axis, b.axis), sine);
  if (!T::any(sine > tiny() ? one() : zero())) return;
  const L3 up = towards(crossed, d);
  const auto overlap = [&](const L3& n) { return a.width(n) + b.width(n) - dot(n, d); };
  LeastAxis<T> best = LeastAxis<T>::none();
  V length;
  for (const double turn : {1.0, -1.0}) {
    for (const double share : {0.25, 1.0, 4.0}) {
      const L3 mixed = a.axis + b.axis * T::broadcast(static_cast<Scalar>(turn * share));
      const L3 flat = towards(unit(mixed, length), d);
      for (const double steep : {0.3, 1.5}) {
        const L3 n = unit(flat + up * T::broadcast(static_cast<Scalar>(steep)), length);
        best.consider(overlap(n), n);
      }
    }
  }
  near_cap(a, b, d, best);
  near_cap(b, a, d, best);
  const V quarter = T::broadcast(Scalar(0.25)), half = T::broadcast(Scalar(0.5));
  const V least_sine = tiny();
  V step_share = one();
  for (int i = 0; i < num_iterations; ++i) {
    const L3& n = best.normal;
    const V along_a = dot(a.axis, n), along_b = dot(b.axis, n);
    const L3 cross_a = cross(a.axis, n), cross_b = cross(b.axis, n);
    const V sine_a = T::max(T::sqrt(dot(cross_a, cross_a)), least_sine);
    const V sine_b = T::max(T::sqrt(dot(cross_b, cross_b)), least_sine);
    const V curve_a = a.radius / sine_a, curve_b = b.radius / sine_b;
    const L3 support = a.axis * (a.half * sign_of(along_a) - along_a * curve_a) +
                       b.axis * (b.half * sign_of(along_b) - along_b * curve_b) + n * (curve_a + curve_b) - d;
    const L3 e = cross_a * (one() / sine_a), f = cross(n, e), t = cross_b * (one() / sine_b);
    const V t_e = dot(t, e), t_f = dot(t, f), slope_e = dot(support, e), slope_f = dot(support, f);
    const V ee = curve_a + curve_b * t_e * t_e, ef = curve_b * t_e * t_f, ff = curve_b * t_f * t_f;
    const V trace = ee + ff, flattest = T::max(ee * ff - ef * ef, zero()) / trace;
    // Deep inside, the overlap would make the Hessian indefinite.
    const V shift = T::max(-best.overlap, -half * flattest) + trace * T::broadcast(static_cast<Scalar>(1e-6));
    const V m_ee = ee + shift, m_ff = ff + shift, inverse = one() / (m_ee * m_ff - ef * ef);
    const V step_e = (slope_f * ef - slope_e * m_ff) * inverse,
            step_f = (slope_e * ef - slope_f * m_ee) * inverse;
    const V far = T::sqrt(step_e * step_e + step_f * step_f);
    const V share = step_share * (far > half ? half / far : one());
    const L3 next = unit(n + e * (step_e * share) + f * (step_f * share), length);
    const V next_overlap = overlap(next);
    step_share = next_overlap < best.overlap ? T::min(step_share + step_share, one()) : step_share * quarter;
    best.consider(next_overlap, next);
  }
  others.consider(sine > tiny() ? best.overlap : huge(), best.normal);
}

}  // namespace pbmpi::solver
