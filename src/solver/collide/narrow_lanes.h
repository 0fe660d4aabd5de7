/// Collides pairs of geoms in lanes: one kernel for each kind of pair. What counts as touching, and which
/// points a pair gets, is as in ODE 0.16 (ode/src/{sphere,capsule,box,plane}.cpp), but for capsules deep in a
/// box (segment_box_lanes.h); the normal points into a.
#pragma once

#include "solver/collide/box_lanes.h"
#include "solver/collide/segment_box_lanes.h"

namespace pbmpi::solver {

/// A point of each lane's pair, where the flag `touching` is not 0.
template <class V>
struct alignas(sizeof(V)) FoundPoint {
  V touching;
  Vec3L<V> position, normal;
  V depth;
};

/// What a kernel found.
template <class V>
struct alignas(sizeof(V)) Found {
  FoundPoint<V> points[Touch::most_points];
  int num_points = 0;  ///< that this kind of pair can have
};

template <class T>
class NarrowLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;
  using Side = GeomSide<T>;

  /// Runs the kernels over all pairs of the table.
  static void collide(const GeomLanes<T>& geoms, PairTable& table) {
    Writer writer{table.touches(), table.points()};
    run(geoms, table.column(PairKind::sphere_plane), writer, sphere_plane);
    run(geoms, table.column(PairKind::capsule_plane), writer, capsule_plane);
    run(geoms, table.column(PairKind::box_plane), writer, box_plane);
    run(geoms, table.column(PairKind::cylinder_plane), writer, cylinder_plane);
    run(geoms, table.column(PairKind::sphere_sphere), writer, sphere_sphere);
    run(geoms, table.column(PairKind::capsule_sphere), writer, capsule_sphere);
    run(geoms, table.column(PairKind::sphere_box), writer, sphere_box);
    run(geoms, table.column(PairKind::capsule_capsule), writer, capsule_capsule);
    run(geoms, table.column(PairKind::capsule_box), writer, capsule_box);
    collide_boxes(geoms, table.column(PairKind::box_box), writer);
  }

 private:
  struct Writer {
    Touch* touches;
    TouchPoint* points;
    int next_point = 0;
  };
  using Kernel = void(const Side& a, const Side& b, Found<V>& found);

  static void run(const GeomLanes<T>& geoms, const PairColumn& column, Writer& writer, Kernel* kernel) {
    Found<V> found{};
    for (int i = 0; i < column.count; i += T::num_lanes) {
      kernel({&geoms, column.a.data() + i}, {&geoms, column.b.data() + i}, found);
      write(found, column.touch.data() + i, lanes_used(column, i), writer);
    }
  }

  /// A bit for each lane from pair `first` on that is not padding.
  static unsigned lanes_used(const PairColumn& column, int first) {
    const int count = column.count - first < T::num_lanes ? column.count - first : T::num_lanes;
    return (1u << count) - 1;
  }
  static void write(const Found<V>& found, const std::int32_t* touch_of, unsigned lanes, Writer& writer);

  PBMPI_LANES static V flag(auto mask) { return mask ? T::broadcast(1) : T::broadcast(0); }
  PBMPI_LANES static V clamp(const V& x, const V& bound) { return T::min(T::max(x, -bound), bound); }

  PBMPI_LANES static FoundPoint<V> spheres(const L3& pa, const V& ra, const L3& pb, const V& rb);
  PBMPI_LANES static FoundPoint<V> sphere_on_plane(const L3& centre, const V& radius, const L3& origin,
                                                   const L3& normal);

  static void sphere_plane(const Side& a, const Side& b, Found<V>& found);
  static void capsule_plane(const Side& a, const Side& b, Found<V>& found);
  static void box_plane(const Side& a, const Side& b, Found<V>& found);
  static void cylinder_plane(const Side& a, const Side& b, Found<V>& found);
  static void sphere_sphere(const Side& a, const Side& b, Found<V>& found);
  static void capsule_sphere(const Side& a, const Side& b, Found<V>& found);
  static void sphere_box(const Side& a, const Side& b, Found<V>& found);
  static void capsule_capsule(const Side& a, const Side& b, Found<V>& found);
  static void capsule_box(const Side& a, const Side& b, Found<V>& found);
  static void collide_boxes(const GeomLanes<T>& geoms, const PairColumn& column, Writer& writer);
  static BoxPose<Scalar> box_at(const GeomLanes<T>& geoms, int index);
};

template <class T>
void NarrowLanes<T>::write(const Found<V>& found, const std::int32_t* touch_of, unsigned lanes,
                           Writer& writer) {
  V any = found.points[0].touching;
  for (int i = 1; i < found.num_points; ++i) any += found.points[i].touching;
  unsigned touching = T::bits(any) & lanes;
  for (; touching != 0; touching &= touching - 1) {
    const int lane = __builtin_ctz(touching);
    Touch& touch = writer.touches[touch_of[lane]];
    touch.first_point = writer.next_point;
    for (int i = 0; i < found.num_points; ++i) {
      if (T::get(found.points[i].touching, lane) == 0) continue;
      const L3 &p = found.points[i].position, &n = found.points[i].normal;
      writer.points[writer.next_point++] = {{T::get(p.x, lane), T::get(p.y, lane), T::get(p.z, lane)},
                                            {T::get(n.x, lane), T::get(n.y, lane), T::get(n.z, lane)},
                                            T::get(found.points[i].depth, lane)};
      ++touch.num_points;
    }
  }
}

template <class T>
PBMPI_LANES FoundPoint<typename T::V> NarrowLanes<T>::spheres(const L3& pa, const V& ra, const L3& pb,
                                                              const V& rb) {
  const V zero = T::broadcast(0), one = T::broadcast(1), half = T::broadcast(Scalar(0.5));
  const L3 apart = pa - pb;
  const V distance = T::sqrt(dot(apart, apart));
  const auto together = distance <= zero;
  const V inverse = one / (together ? one : distance);
  const L3 normal{together ? one : apart.x * inverse, apart.y * inverse, apart.z * inverse};
  const V k = together ? zero : half * (rb - ra - distance);
  return {flag(distance <= ra + rb), pa + normal * k, normal, ra + rb - distance};
}

template <class T>
PBMPI_LANES FoundPoint<typename T::V> NarrowLanes<T>::sphere_on_plane(const L3& centre, const V& radius,
                                                                      const L3& origin, const L3& normal) {
  const V depth = radius - dot(centre - origin, normal);
  return {flag(depth >= T::broadcast(0)), centre - normal * radius, normal, depth};
}

template <class T>
void NarrowLanes<T>::sphere_plane(const Side& a, const Side& b, Found<V>& found) {
  found.points[0] = sphere_on_plane(a.centre(), a.radius(), b.centre(), b.axis(2));
  found.num_points = 1;
}

/// The lower end first.
template <class T>
void NarrowLanes<T>::capsule_plane(const Side& a, const Side& b, Found<V>& found) {
  const L3 centre = a.centre(), axis = a.axis(2), origin = b.centre(), normal = b.axis(2);
  const V length = a.half(2), radius = a.radius();
  const V end = dot(axis, normal) > T::broadcast(0) ? -length : length;
  found.points[0] = sphere_on_plane(centre + axis * end, radius, origin, normal);
  found.points[1] = sphere_on_plane(centre - axis * end, radius, origin, normal);
  found.points[1].touching *= found.points[0].touching;
  found.num_points = 2;
}

/// The deepest corner, its neighbours along the two edges that rise least, and the corner across.
template <class T>
void NarrowLanes<T>::box_plane(const Side& a, const Side& b, Found<V>& found) {
  const V zero = T::broadcast(0);
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
  const V w0 = first2 ? zero : flag(first0), w2 = flag(first2), w1 = T::broadcast(1) - w0 - w2;
  const V v0 = w0 > zero ? zero : (w2 > zero ? flag(rise[0] < rise[1]) : flag(rise[0] < rise[2]));
  const V v1 = w1 > zero ? zero : (w2 > zero ? T::broadcast(1) - v0 : flag(rise[1] < rise[2]));
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
    const V touching = i < 3 ? (depths[i] >= zero ? before : zero) : (depths[i] > zero ? before : zero);
    found.points[i] = {touching, corners[i], normal, depths[i]};
    before = touching;
  }
  found.num_points = 4;
}

/// The lowest points of both rims, and of the lower disc the points beside and opposite to its lowest: a
/// wheel stands on two points, a cylinder on its end on four. (ODE finds the same lowest points; the others
/// follow where it looks along its own axes.)
template <class T>
void NarrowLanes<T>::cylinder_plane(const Side& a, const Side& b, Found<V>& found) {
  const V zero = T::broadcast(0), one = T::broadcast(1);
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
    const V touching = flag(depth >= zero);
    if (i ==
        4) {  // in the place of the upper rim's, which is off the plane when the whole lower disc is on it
      const auto instead = touching * (one - rest) > zero;
      const auto pick = [&](const V& x, const V& otherwise) { return instead ? x : otherwise; };
      FoundPoint<V>& point = found.points[1];
      point = {pick(touching, point.touching),
               {pick(points[i].x, point.position.x), pick(points[i].y, point.position.y),
                pick(points[i].z, point.position.z)},
               normal,
               pick(depth, point.depth)};
      break;
    }
    found.points[i] = {touching, points[i], normal, depth};
    if (i == 1) rest = touching;
  }
  found.num_points = 4;
}

template <class T>
void NarrowLanes<T>::sphere_sphere(const Side& a, const Side& b, Found<V>& found) {
  found.points[0] = spheres(a.centre(), a.radius(), b.centre(), b.radius());
  found.num_points = 1;
}

template <class T>
void NarrowLanes<T>::capsule_sphere(const Side& a, const Side& b, Found<V>& found) {
  const L3 pa = a.centre(), axis = a.axis(2), pb = b.centre();
  found.points[0] = spheres(pa + axis * clamp(dot(axis, pb - pa), a.half(2)), a.radius(), pb, b.radius());
  found.num_points = 1;
}

template <class T>
void NarrowLanes<T>::sphere_box(const Side& a, const Side& b, Found<V>& found) {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const L3 pa = a.centre(), pb = b.centre(), apart = pa - pb;
  const V radius = a.radius();
  L3 nearest = pb, outward{zero, zero, zero};  // outward: of the nearest face, for a centre inside
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
  found.points[0] = {flag(depth >= zero),
                     {within ? pa.x : nearest.x, within ? pa.y : nearest.y, within ? pa.z : nearest.z},
                     {within ? outward.x : gap.x * inverse, within ? outward.y : gap.y * inverse,
                      within ? outward.z : gap.z * inverse},
                     depth};
  found.num_points = 1;
}

/// Parallel capsules side by side touch at both ends of what they share.
template <class T>
void NarrowLanes<T>::capsule_capsule(const Side& a, const Side& b, Found<V>& found) {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const L3 pa = a.centre(), pb = b.centre(), da = a.axis(2), db = b.axis(2), apart = pa - pb;
  const V ha = a.half(2), hb = b.half(2), ra = a.radius(), rb = b.radius();
  const V cosine = dot(da, db), along_a = dot(da, apart), along_b = dot(db, apart);
  const V sine2 = one - cosine * cosine;
  const V parallel = flag(sine2 < T::broadcast(Scalar(1e-5)));
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
    return spheres(pa + da * along, ra, pb + db * ((along + along_a) * turned), rb);
  };
  const FoundPoint<V> low_end = beside_at(lo), high_end = beside_at(hi);
  const V both = lo < hi ? beside * low_end.touching * high_end.touching : zero;
  const V middle = (lo + hi) * T::broadcast(Scalar(0.5));
  const V at_a = beside > zero ? middle : s;
  const V at_b = beside > zero ? (middle + along_a) * turned : t;
  const FoundPoint<V> single = spheres(pa + da * at_a, ra, pb + db * at_b, rb);
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
void NarrowLanes<T>::capsule_box(const Side& a, const Side& b, Found<V>& found) {
  const V radius = a.radius();
  const SegmentPlace<V> place = SegmentAtBox<T>(a, b).nearest_place();
  const V depth = radius - place.distance;
  const V inwards = T::broadcast(Scalar(0.5)) * (radius + place.distance);
  found.points[0] = {flag(depth >= T::broadcast(0)), place.point - place.normal * inwards, place.normal,
                     depth};
  found.num_points = 1;
}

template <class T>
void NarrowLanes<T>::collide_boxes(const GeomLanes<T>& geoms, const PairColumn& column, Writer& writer) {
  for (int i = 0; i < column.count; i += T::num_lanes) {
    const BoxAxis<V> axis = separate_boxes<T>({&geoms, column.a.data() + i}, {&geoms, column.b.data() + i});
    unsigned touching = T::bits(axis.touching) & lanes_used(column, i);
    for (; touching != 0; touching &= touching - 1) {
      const int lane = __builtin_ctz(touching);
      Touch& touch = writer.touches[column.touch.data()[i + lane]];
      touch.first_point = writer.next_point;
      touch.num_points = static_cast<short>(BoxManifold<T>::find(
          box_at(geoms, column.a.data()[i + lane]), box_at(geoms, column.b.data()[i + lane]),
          static_cast<int>(T::get(axis.code, lane)), T::get(axis.depth, lane),
          writer.points + writer.next_point));
      writer.next_point += touch.num_points;
    }
  }
}

template <class T>
BoxPose<typename T::Scalar> NarrowLanes<T>::box_at(const GeomLanes<T>& geoms, int index) {
  BoxPose<Scalar> box;
  for (int k = 0; k < 3; ++k) {
    box.centre[k] = geoms.position[k].data()[index];
    box.half[k] = geoms.half[k].data()[index];
    for (int axis = 0; axis < 3; ++axis) box.axis[axis][k] = geoms.rotation[3 * k + axis].data()[index];
  }
  return box;
}

}  // namespace pbmpi::solver
