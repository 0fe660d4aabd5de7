/// A capsule's segment against a box, in lanes.
#pragma once

#include "solver/collide/geom_lanes.h"

namespace pbmpi::solver {

/// The place of a segment that is nearest to a box, or deepest in it if the segment enters it.
template <class V>
struct alignas(sizeof(V)) SegmentPlace {
  Vec3L<V> point;
  Vec3L<V> normal;  ///< out of the box
  V distance;       ///< from the box; negative inside
};

/// Computes in the box's frame; results are in the world frame.
template <class T>
class SegmentAtBox {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using L3 = Vec3L<V>;

  PBMPI_LANES SegmentAtBox(const GeomSide<T>& capsule, const GeomSide<T>& box)
      : centre_(capsule.centre()), direction_(capsule.axis(2)), length_(capsule.half(2)) {
    const L3 apart = centre_ - box.centre();
    for (int k = 0; k < 3; ++k) {
      axis_[k] = box.axis(k);
      half_[k] = box.half(k);
      at_[k] = dot(apart, axis_[k]);
      along_[k] = dot(direction_, axis_[k]);
    }
  }

  PBMPI_LANES SegmentPlace<V> nearest_place() const;

 private:
  PBMPI_LANES static V clamp(const V& x, const V& bound) { return T::min(T::max(x, -bound), bound); }
  /// How far the segment's point at t lies outside the box along axis k; 0 within the box's extent.
  PBMPI_LANES V beyond(const V& t, int k) const {
    const V y = at_[k] + t * along_[k];
    return y - clamp(y, half_[k]);
  }
  /// Half the derivative of the squared distance from the box.
  PBMPI_LANES V slope(const V& t) const {
    V sum = T::broadcast(0);
    for (int k = 0; k < 3; ++k) sum += along_[k] * beyond(t, k);
    return sum;
  }
  PBMPI_LANES V nearest_t() const;
  PBMPI_LANES SegmentPlace<V> way_out() const;

  L3 centre_, direction_, axis_[3];  // world frame
  V length_;                         // half the segment's
  V at_[3], along_[3], half_[3];     // the segment's centre and direction, the box
};

/// The slope rises, and is linear between the points where the segment passes the box's planes, so that the
/// values at these points bracket its root. Where the segment runs along a face there are many roots, and the
/// middle one is taken.
template <class T>
PBMPI_LANES typename T::V SegmentAtBox<T>::nearest_t() const {
  const V zero = T::broadcast(0), one = T::broadcast(1), half = T::broadcast(Scalar(0.5));
  V falls = -length_, falls_or_flat = -length_;  // the last place with a negative slope
  V rises = length_, rises_or_flat = length_;    // the first place with a positive slope
  const auto look_at = [&](const V& t) {
    const V g = slope(t);
    falls = T::max(falls, g < zero ? t : -length_);
    falls_or_flat = T::max(falls_or_flat, g <= zero ? t : -length_);
    rises = T::min(rises, g > zero ? t : length_);
    rises_or_flat = T::min(rises_or_flat, g >= zero ? t : length_);
  };
  look_at(-length_);
  look_at(length_);
  for (int k = 0; k < 3; ++k) {
    const V inverse = one / (along_[k] == zero ? one : along_[k]);
    look_at(clamp((half_[k] - at_[k]) * inverse, length_));
    look_at(clamp((-half_[k] - at_[k]) * inverse, length_));
  }
  const auto root = [&](const V& t0, const V& t1) {
    const V g0 = slope(t0), rise = slope(t1) - g0;
    const V share = rise > zero ? -g0 / (rise > zero ? rise : one) : half;
    return t0 + (t1 - t0) * T::min(T::max(share, zero), one);
  };
  return half * (root(falls, rises_or_flat) + root(falls_or_flat, rises));
}

template <class T>
PBMPI_LANES SegmentPlace<typename T::V> SegmentAtBox<T>::nearest_place() const {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const V t = nearest_t();
  L3 gap{zero, zero, zero};
  for (int k = 0; k < 3; ++k) gap = gap + axis_[k] * beyond(t, k);
  const V distance = T::sqrt(dot(gap, gap));
  // The direction of such a short gap is rounding noise.
  const V scale = length_ + half_[0] + half_[1] + half_[2];
  const V nothing = scale * T::broadcast(sizeof(Scalar) == 4 ? Scalar(1e-6) : Scalar(1e-14));
  const auto enters = distance <= nothing;
  SegmentPlace<V> place{centre_ + direction_ * t, gap * (one / (enters ? one : distance)), distance};
  if (T::bits(enters ? one : zero) != 0) {
    const SegmentPlace<V> out = way_out();
    const auto choose = [&](V& x, const V& instead) { x = enters ? instead : x; };
    choose(place.point.x, out.point.x);
    choose(place.point.y, out.point.y);
    choose(place.point.z, out.point.z);
    choose(place.normal.x, out.normal.x);
    choose(place.normal.y, out.normal.y);
    choose(place.normal.z, out.normal.z);
    choose(place.distance, out.distance);
  }
  return place;
}

/// A segment that enters the box leaves it through the face under which the part inside is least deep. (ODE
/// takes the x axis of the world as the normal, so that a limb that has entered a car stays there.) The part
/// inside is represented by the centre of its depth: an end at the face has no weight, two equally deep ends
/// have equal weights.
template <class T>
PBMPI_LANES SegmentPlace<typename T::V> SegmentAtBox<T>::way_out() const {
  const V zero = T::broadcast(0), one = T::broadcast(1), half = T::broadcast(Scalar(0.5));
  V first = -length_, last = length_;  // the part inside
  for (int k = 0; k < 3; ++k) {
    const auto level = along_[k] == zero;
    const V inverse = one / (level ? one : along_[k]);
    const V low = (-half_[k] - at_[k]) * inverse, high = (half_[k] - at_[k]) * inverse;
    first = level ? first : T::max(first, T::min(low, high));
    last = level ? last : T::min(last, T::max(low, high));
  }
  const V middle = half * (first + last);  // if rounding leaves nothing inside
  const auto crossed = first > last;
  first = crossed ? middle : first;
  last = crossed ? middle : last;

  V least = T::broadcast(static_cast<Scalar>(huge_bound)), depth_first = zero, depth_last = zero;
  L3 normal{zero, zero, zero};
  for (int k = 0; k < 3; ++k) {
    for (const Scalar side : {Scalar(1), Scalar(-1)}) {
      const V towards = T::broadcast(side);
      const V d0 = T::max(half_[k] - towards * (at_[k] + first * along_[k]), zero);
      const V d1 = T::max(half_[k] - towards * (at_[k] + last * along_[k]), zero);
      const V deepest = T::max(d0, d1);
      const auto less = deepest < least;
      least = less ? deepest : least;
      depth_first = less ? d0 : depth_first;
      depth_last = less ? d1 : depth_last;
      normal.x = less ? axis_[k].x * towards : normal.x;
      normal.y = less ? axis_[k].y * towards : normal.y;
      normal.z = less ? axis_[k].z * towards : normal.z;
    }
  }
  const V sum = depth_first + depth_last;
  const V share = sum > zero ? depth_last / (sum > zero ? sum : one) : half;
  const V t = first + (last - first) * share;
  return {centre_ + direction_ * t, normal, -(depth_first + (depth_last - depth_first) * share)};
}

}  // namespace pbmpi::solver
