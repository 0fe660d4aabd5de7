/// Spheres, capsules, boxes and cylinders on planes, in lanes.
#pragma once

#include "solver/collide/found_points.h"

namespace pbmpi::solver {

/// a is the solid, b the plane.
template <class T>
class PlaneKernels {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;
  using Side = GeomSide<T>;

  static void sphere_plane(const Side& a, const Side& b, Found<V>& found);
  static void capsule_plane(const Side& a, const Side& b, Found<V>& found);
  static void box_plane(const Side& a, const Side& b, Found<V>& found);
  static void cylinder_plane(const Side& a, const Side& b, Found<V>& found);

 private:
  /// Half way from a point of the solid to the plane.
  PBMPI_LANES static L3 between(const L3& point, const L3& normal, const V& depth) {
    return point + normal * (T::broadcast(Scalar(0.5)) * depth);
  }
  PBMPI_LANES static FoundPoint<V> sphere_on_plane(const L3& centre, const V& radius, const L3& origin,
                                                   const L3& normal, const V& least_depth);
};

template <class T>
PBMPI_LANES FoundPoint<typename T::V> PlaneKernels<T>::sphere_on_plane(const L3& centre, const V& radius,
                                                                       const L3& origin, const L3& normal,
                                                                       const V& least_depth) {
  const V depth = radius - dot(centre - origin, normal);
  const V way = radius - T::broadcast(Scalar(0.5)) * depth;
  return {flag<T>(depth >= least_depth), centre - normal * way, normal, depth};
}

template <class T>
void PlaneKernels<T>::sphere_plane(const Side& a, const Side& b, Found<V>& found) {
  found.points[0] = sphere_on_plane(a.centre(), a.radius(), b.centre(), b.axis(2), a.least_depth());
  found.num_points = 1;
}

/// Finds the lower end first.
template <class T>
void PlaneKernels<T>::capsule_plane(const Side& a, const Side& b, Found<V>& found) {
  const L3 centre = a.centre(), axis = a.axis(2), origin = b.centre(), normal = b.axis(2);
  const V length = a.half(2), radius = a.radius(), least_depth = a.least_depth();
  const V end = dot(axis, normal) > T::broadcast(0) ? -length : length;
  found.points[0] = sphere_on_plane(centre + axis * end, radius, origin, normal, least_depth);
  found.points[1] = sphere_on_plane(centre - axis * end, radius, origin, normal, least_depth);
  found.points[1].touching *= found.points[0].touching;
  found.num_points = 2;
}

/// Finds the deepest corner, its neighbours along the two edges that rise least, and the corner opposite.
template <class T>
void PlaneKernels<T>::box_plane(const Side& a, const Side& b, Found<V>& found) {
  const V zero = T::broadcast(0), least_depth = a.least_depth();
  const L3 centre = a.centre(), normal = b.axis(2);
  L3 edge[3], corner = centre;
  V rise[3], depth = -dot(centre - b.centre(), normal);
  for (int k = 0; k < 3; ++k) {
    const V half = a.half(k);
    const L3 axis = a.axis(k);
    const V slope = dot(axis, normal);
    const V towards = slope > zero ? half : -half;
    edge[k] = axis * (towards + towards);
    corner = corner - axis * towards;
    rise[k] = T::abs((half + half) * slope);
    depth += T::abs(half * slope);
  }
  // 0 or 1: is edge k the least steep, is it the next?
  const auto first2 = rise[2] < T::min(rise[0], rise[1]);
  const auto first0 = rise[0] < rise[1];
  const V w0 = first2 ? zero : flag<T>(first0), w2 = flag<T>(first2), w1 = T::broadcast(1) - w0 - w2;
  const V v0 = w0 > zero ? zero : (w2 > zero ? flag<T>(rise[0] < rise[1]) : flag<T>(rise[0] < rise[2]));
  const V v1 = w1 > zero ? zero : (w2 > zero ? T::broadcast(1) - v0 : flag<T>(rise[1] < rise[2]));
  const V v2 = T::broadcast(1) - v0 - v1;
  const V rise_first = w0 > zero ? rise[0] : (w1 > zero ? rise[1] : rise[2]);
  const V rise_next = v0 > zero ? rise[0] : (v1 > zero ? rise[1] : rise[2]);
  const L3 along_first = edge[0] * w0 + edge[1] * w1 + edge[2] * w2;
  const L3 along_next = edge[0] * v0 + edge[1] * v1 + edge[2] * v2;
  const V depths[4] = {depth, depth - rise_first, depth - rise_next, depth - rise_first - rise_next};
  const L3 corners[4] = {corner, corner + along_first, corner + along_next,
                         corner + along_first + along_next};
  V before = T::broadcast(1);
  for (int i = 0; i < 4; ++i) {
    const V touching =
        i < 3 ? (depths[i] >= least_depth ? before : zero) : (depths[i] > least_depth ? before : zero);
    found.points[i] = {touching, between(corners[i], normal, depths[i]), normal, depths[i]};
    before = touching;
  }
  found.num_points = 4;
}

/// Finds the lowest points of both rims, and the points of the lower disc beside and opposite its lowest: a
/// wheel stands on two points, an upright cylinder on four. (ODE finds the same lowest points; the others
/// follow where it looks along its own axes.)
template <class T>
void PlaneKernels<T>::cylinder_plane(const Side& a, const Side& b, Found<V>& found) {
  const V zero = T::broadcast(0), one = T::broadcast(1), least_depth = a.least_depth();
  const L3 centre = a.centre(), axis = a.axis(2), origin = b.centre(), normal = b.axis(2);
  const V radius = a.radius(), slope = dot(axis, normal);
  const V end = slope > zero ? -a.half(2) : a.half(2);
  const L3 across = normal - axis * slope;  // of length sin(angle)
  const V sine = T::sqrt(dot(across, across));
  const auto upright =
      sine < T::broadcast(static_cast<Scalar>(1e-4));  // any direction will do: the disc's own
  const V inverse = one / (upright ? one : sine);
  const L3 own = a.axis(0);
  const L3 up{upright ? own.x : across.x * inverse, upright ? own.y : across.y * inverse,
              upright ? own.z : across.z * inverse};
  const L3 beside = cross(axis, up);
  const L3 lower = centre + axis * end, upper = centre - axis * end;
  const L3 points[5] = {lower - up * radius, upper - up * radius, lower + beside * radius,
                        lower - beside * radius, lower + up * radius};
  V rest = T::broadcast(0);
  for (int i = 0; i < 5; ++i) {
    const V depth = -dot(points[i] - origin, normal);
    const L3 place = between(points[i], normal, depth);
    const V touching = flag<T>(depth >= least_depth);
    if (i ==
        4) {  // replaces the upper rim's point, which is off the plane when the whole lower disc is on it
      const auto instead = touching * (one - rest) > zero;
      const auto pick = [&](const V& x, const V& otherwise) { return instead ? x : otherwise; };
      FoundPoint<V>& point = found.points[1];
      point = {
          pick(touching, point.touching),
          {pick(place.x, point.position.x), pick(place.y, point.position.y), pick(place.z, point.position.z)},
          normal,
          pick(depth, point.depth)};
      break;
    }
    found.points[i] = {touching, place, normal, depth};
    if (i == 1) rest = touching;
  }
  found.num_points = 4;
}

}  // namespace pbmpi::solver
