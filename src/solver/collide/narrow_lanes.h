/// Collides pairs of geoms in lanes: one kernel for each kind of pair. What counts as touching, and which
/// points a pair gets, is as in ODE 0.16 (ode/src/{sphere,capsule,box,plane}.cpp), except for capsules deep
/// in a box (segment_box_lanes.h) and for cylinders (cylinder_axes.h); the normal points into a.
#pragma once

#include "solver/collide/box_lanes.h"
#include "solver/collide/cylinder_axes.h"
#include "solver/collide/cylinder_manifold.h"
#include "solver/collide/plane_kernels.h"
#include "solver/collide/round_kernels.h"

namespace pbmpi::solver {

template <class T>
class NarrowLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;
  using Side = GeomSide<T>;

  /// Runs the kernels over all pairs of the table.
  static void collide(const GeomLanes<T>& geoms, PairTable& table) {
    using Planes = PlaneKernels<T>;
    using Rounds = RoundKernels<T>;
    Writer writer{table.touches(), table.points()};
    run(geoms, table.column(PairKind::sphere_plane), writer, Planes::sphere_plane);
    run(geoms, table.column(PairKind::capsule_plane), writer, Planes::capsule_plane);
    run(geoms, table.column(PairKind::box_plane), writer, Planes::box_plane);
    run(geoms, table.column(PairKind::cylinder_plane), writer, Planes::cylinder_plane);
    run(geoms, table.column(PairKind::sphere_sphere), writer, Rounds::sphere_sphere);
    run(geoms, table.column(PairKind::capsule_sphere), writer, Rounds::capsule_sphere);
    run(geoms, table.column(PairKind::sphere_box), writer, Rounds::sphere_box);
    run(geoms, table.column(PairKind::capsule_capsule), writer, Rounds::capsule_capsule);
    run(geoms, table.column(PairKind::capsule_box), writer, Rounds::capsule_box);
    collide_boxes(geoms, table.column(PairKind::box_box), writer);
    using Axes = CylinderAxes<T>;
    run(geoms, table.column(PairKind::cylinder_sphere), writer, Rounds::cylinder_sphere);
    run_cylinders(geoms, table.column(PairKind::cylinder_capsule), writer, Axes::with_capsule,
                  Shape::capsule);
    run_cylinders(geoms, table.column(PairKind::cylinder_box), writer, Axes::with_box, Shape::box);
    run_cylinders(geoms, table.column(PairKind::cylinder_cylinder), writer, Axes::with_cylinder,
                  Shape::cylinder);
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

  static void collide_boxes(const GeomLanes<T>& geoms, const PairColumn& column, Writer& writer);
  static BoxPose<Scalar> box_at(const GeomLanes<T>& geoms, int index);

  using Shape = model::Shape;
  using Axis = void(const Side& a, const Side& b, LeastAxis<T>& least);
  /// a is a cylinder, b of the given shape.
  static void run_cylinders(const GeomLanes<T>& geoms, const PairColumn& column, Writer& writer, Axis* axis,
                            Shape shape);
  static SolidPose<Scalar> solid_at(const GeomLanes<T>& geoms, int index, Shape shape);
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
          -geoms.margin.data()[column.a.data()[i + lane]], writer.points + writer.next_point));
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

template <class T>
void NarrowLanes<T>::run_cylinders(const GeomLanes<T>& geoms, const PairColumn& column, Writer& writer,
                                   Axis* axis, Shape shape) {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  for (int i = 0; i < column.count; i += T::num_lanes) {
    LeastAxis<T> least = LeastAxis<T>::none();
    axis({&geoms, column.a.data() + i}, {&geoms, column.b.data() + i}, least);
    // A pair that is not finite has found no axis.
    const V found = least.overlap < T::broadcast(static_cast<Scalar>(huge_bound)) ? one : zero;
    const V least_depth = GeomSide<T>{&geoms, column.a.data() + i}.least_depth();
    unsigned touching = T::bits(least.overlap >= least_depth ? found : zero) & lanes_used(column, i);
    for (; touching != 0; touching &= touching - 1) {
      const int lane = __builtin_ctz(touching);
      const L3& n = least.normal;
      const Scalar normal[3] = {T::get(n.x, lane), T::get(n.y, lane), T::get(n.z, lane)};
      Touch& touch = writer.touches[column.touch.data()[i + lane]];
      touch.first_point = writer.next_point;
      touch.num_points = static_cast<short>(CylinderManifold<T>::find(
          solid_at(geoms, column.a.data()[i + lane], Shape::cylinder),
          solid_at(geoms, column.b.data()[i + lane], shape), normal, T::get(least.overlap, lane),
          geoms.margin.data()[column.a.data()[i + lane]], writer.points + writer.next_point));
      writer.next_point += touch.num_points;
    }
  }
}

template <class T>
SolidPose<typename T::Scalar> NarrowLanes<T>::solid_at(const GeomLanes<T>& geoms, int index, Shape shape) {
  return {box_at(geoms, index), geoms.radius.data()[index], shape};
}

}  // namespace pbmpi::solver
