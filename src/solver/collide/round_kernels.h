/// Spheres and capsules against each other and against boxes, and spheres against cylinders, in lanes.
#pragma once

#include "solver/collide/found_points.h"
#include "solver/collide/segment_box_lanes.h"

namespace pbmpi::solver {

/// a and b are in the order of the kernel's name.
template <class T>
class RoundKernels {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;
  using Side = GeomSide<T>;

  static void sphere_sphere(const Side& a, const Side& b, Found<V>& found);
  static void capsule_sphere(const Side& a, const Side& b, Found<V>& found);
  static void sphere_box(const Side& a, const Side& b, Found<V>& found);
  static void capsule_capsule(const Side& a, const Side& b, Found<V>& found);
  static void capsule_box(const Side& a, const Side& b, Found<V>& found);
  static void cylinder_sphere(const Side& a, const Side& b, Found<V>& found);

 private:
  PBMPI_LANES static V clamp(const V& x, const V& bound) { return T::min(T::max(x, -bound), bound); }
  PBMPI_LANES static FoundPoint<V> spheres(const L3& pa, const V& ra, const L3& pb, const V& rb,
                                           const V& least_depth);
};

template <class T>
PBMPI_LANES FoundPoint<typename T::V> RoundKernels<T>::spheres(const L3& pa, const V& ra, const L3& pb,
                                                               const V& rb, const V& least_depth) {
  const V zero = T::broadcast(0), one = T::broadcast(1), half = T::broadcast(Scalar(0.5));
  const L3 apart = pa - pb;
  const V distance = T::sqrt(dot(apart, apart));
  const auto together = distance <= zero;
  const V inverse = one / (together ? one : distance);
  const L3 normal{together ? one : apart.x * inverse, apart.y * inverse, apart.z * inverse};
  const V k = together ? zero : half * (rb - ra - distance);
  return {flag<T>(distance <= ra + rb - least_depth), pa + normal * k, normal, ra + rb - distance};
}

template <class T>
void RoundKernels<T>::sphere_sphere(const Side& a, const Side& b, Found<V>& found) {
  found.points[0] = spheres(a.centre(), a.radius(), b.centre(), b.radius(), a.least_depth());
  found.num_points = 1;
}

template <class T>
void RoundKernels<T>::capsule_sphere(const Side& a, const Side& b, Found<V>& found) {
  const L3 pa = a.centre(), axis = a.axis(2), pb = b.centre();
  found.points[0] =
      spheres(pa + axis * clamp(dot(axis, pb - pa), a.half(2)), a.radius(), pb, b.radius(), a.least_depth());
  found.num_points = 1;
}

template <class T>
void RoundKernels<T>::sphere_box(const Side& a, const Side& b, Found<V>& found) {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const L3 pa = a.centre(), pb = b.centre(), apart = pa - pb;
  const V radius = a.radius();
  L3 nearest = pb, outward{zero, zero, zero};  // outward: normal of the nearest face, for a centre inside
  V inside = one, least = T::broadcast(static_cast<Scalar>(huge_bound));
  for (int k = 0; k < 3; ++k) {
    const L3 axis = b.axis(k);
    const V half = b.half(k), x = dot(apart, axis);
    inside = T::abs(x) > half ? zero : inside;
    nearest = nearest + axis * clamp(x, half);
    const V to_face = half - T::abs(x);
    const auto nearer = to_face < least;
    least = nearer ? to_face : least;
    const V sign = x > zero ? one : -one;
    outward.x = nearer ? axis.x * sign : outward.x;
    outward.y = nearer ? axis.y * sign : outward.y;
    outward.z = nearer ? axis.z * sign : outward.z;
  }
  const auto within = inside > zero;
  const L3 gap = pa - nearest;
  const V distance = T::sqrt(dot(gap, gap));
  const V inverse = one / (distance > zero ? distance : one);
  const V depth = within ? least + radius : radius - distance;
  const L3 normal{within ? outward.x : gap.x * inverse, within ? outward.y : gap.y * inverse,
                  within ? outward.z : gap.z * inverse};
  const V way = radius - T::broadcast(Scalar(0.5)) * depth;
  found.points[0] = {flag<T>(depth >= a.least_depth()), pa - normal * way, normal, depth};
  found.num_points = 1;
}

/// Parallel capsules side by side touch at both ends of the stretch that they share.
template <class T>
void RoundKernels<T>::capsule_capsule(const Side& a, const Side& b, Found<V>& found) {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const L3 pa = a.centre(), pb = b.centre(), da = a.axis(2), db = b.axis(2), apart = pa - pb;
  const V ha = a.half(2), hb = b.half(2), ra = a.radius(), rb = b.radius();
  const V least_depth = a.least_depth();
  const V cosine = dot(da, db), along_a = dot(da, apart), along_b = dot(db, apart);
  const V sine2 = one - cosine * cosine;
  const V parallel = flag<T>(sine2 < T::broadcast(Scalar(1e-5)));
  // The nearest points of two segments (Ericson, "Real-Time Collision Detection", 5.1.9).
  V s = clamp((cosine * along_b - along_a) / (parallel > zero ? one : sine2), ha);
  const V free_t = cosine * s + along_b;
  const V t = clamp(free_t, hb);
  s = t == free_t ? s : clamp(cosine * t - along_a, ha);
  // Side by side: from lo to hi along a.
  const V lo = T::max(-ha, -hb - along_a), hi = T::min(ha, hb - along_a);
  const V beside = lo <= hi ? parallel : zero;
  const V turned = cosine < zero ? -one : one;
  const auto beside_at = [&](const V& along) {
    return spheres(pa + da * along, ra, pb + db * ((along + along_a) * turned), rb, least_depth);
  };
  const FoundPoint<V> low_end = beside_at(lo), high_end = beside_at(hi);
  const V both = lo < hi ? beside * low_end.touching * high_end.touching : zero;
  const V middle = (lo + hi) * T::broadcast(Scalar(0.5));
  const V at_a = beside > zero ? middle : s;
  const V at_b = beside > zero ? (middle + along_a) * turned : t;
  const FoundPoint<V> single = spheres(pa + da * at_a, ra, pb + db * at_b, rb, least_depth);
  const auto two = both > zero;
  const auto choose = [&](const L3& first, const L3& otherwise) {
    return L3{two ? first.x : otherwise.x, two ? first.y : otherwise.y, two ? first.z : otherwise.z};
  };
  found.points[0] = {two ? low_end.touching : single.touching, choose(low_end.position, single.position),
                     choose(low_end.normal, single.normal), two ? low_end.depth : single.depth};
  found.points[1] = high_end;
  found.points[1].touching = both;
  found.num_points = 2;
}

template <class T>
void RoundKernels<T>::capsule_box(const Side& a, const Side& b, Found<V>& found) {
  const V radius = a.radius();
  const SegmentPlace<V> place = SegmentAtBox<T>(a, b).nearest_place();
  const V depth = radius - place.distance;
  const V inwards = T::broadcast(Scalar(0.5)) * (radius + place.distance);
  found.points[0] = {flag<T>(depth >= a.least_depth()), place.point - place.normal * inwards, place.normal,
                     depth};
  found.num_points = 1;
}

/// The normal is that from the cylinder's nearest point to a centre outside it; a centre inside leaves
/// through the end or the side, whichever is nearer.
template <class T>
void RoundKernels<T>::cylinder_sphere(const Side& a, const Side& b, Found<V>& found) {
  const V zero = T::broadcast(0), one = T::broadcast(1), half = T::broadcast(Scalar(0.5));
  const L3 axis = a.axis(2), own = a.axis(0), centre = b.centre(), apart = centre - a.centre();
  const V length = a.half(2), radius = a.radius(), ball = b.radius();
  const V height = dot(axis, apart);
  const L3 across = apart - axis * height;
  const V distance = T::sqrt(dot(across, across));
  const auto central = distance <= zero;
  const V inverse = one / (central ? one : distance);
  const L3 aside{central ? own.x : across.x * inverse, central ? own.y : across.y * inverse,
                 central ? own.z : across.z * inverse};
  const V beyond_end = height - clamp(height, length), beyond_side = T::max(distance - radius, zero);
  const V gap = T::sqrt(beyond_end * beyond_end + beyond_side * beyond_side);
  const auto inside = gap <= zero;
  const V to_end = length - T::abs(height), to_side = radius - distance;
  const V through_end = to_end < to_side ? (height < zero ? -one : one) : zero;
  const V through_side = to_end < to_side ? zero : one;
  const V unit = one / (inside ? one : gap);
  const L3 out = axis * (inside ? through_end : beyond_end * unit) +
                 aside * (inside ? through_side : beyond_side * unit);
  const V apart_by = inside ? -T::min(to_end, to_side) : gap;
  found.points[0] = {flag<T>(apart_by <= ball - a.least_depth()), centre - out * (half * (ball + apart_by)),
                     -out, ball - apart_by};
  found.num_points = 1;
}

}  // namespace pbmpi::solver
