/// Boxes against boxes: the separating axes in lanes, then the points of those that touch one pair at a time.
#pragma once

#include "solver/collide/geom_lanes.h"
#include "solver/collide/pair_table.h"
#include "solver/collide/spread.h"

namespace pbmpi::solver {

/// How the two boxes of each lane's pair lie relative to each other.
template <class V>
struct alignas(sizeof(V)) BoxAxis {
  V touching;  ///< flag
  V depth;     ///< depth of two edges, or the upper bound of a face's points
  V code;      ///< 0 to 2: face of a, 3 to 5: face of b, 6 + 3 i + j: edges i of a and j of b
};

/// The share of the contact margin by which a face may overlap more than two edges do and still be where the
/// boxes touch.
template <class Scalar>
inline constexpr Scalar face_share_of_margin = static_cast<Scalar>(0.25);

/// The axis of least overlap, or of the widest gap (Gottschalk's 15). As in ODE's dBoxBox a face wins unless
/// the edges overlap less by more than 5 %; edges' gaps count 5 % less, so that a face also wins when the
/// other box is above it.
///
/// Nor do edges win unless they overlap less by more than a share of the margin: a plank that lies across
/// another one and sways overlaps it least between two edges. On that one point it would tip until a later
/// step finds the other three. The points of the face are then no deeper than the edges, except for the 5 %.
template <class T>
BoxAxis<typename T::V> separate_boxes(const GeomSide<T>& a, const GeomSide<T>& b) {
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const Vec3L<V> apart = b.centre() - a.centre();
  Vec3L<V> axis_a[3], axis_b[3];
  V half_a[3], half_b[3], along_a[3], along_b[3], r[3][3], q[3][3];
  for (int k = 0; k < 3; ++k) {
    axis_a[k] = a.axis(k);
    axis_b[k] = b.axis(k);
    half_a[k] = a.half(k);
    half_b[k] = b.half(k);
    along_a[k] = dot(apart, axis_a[k]);
    along_b[k] = dot(apart, axis_b[k]);
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      r[i][j] = dot(axis_a[i], axis_b[j]);
      q[i][j] = T::abs(r[i][j]);
    }
  }
  V gap = T::broadcast(static_cast<Scalar>(-huge_bound)), code = zero;
  const auto look_at = [&](const V& g, const V& rated, int number) {
    const auto less = rated > gap;
    gap = less ? g : gap;
    code = less ? T::broadcast(static_cast<Scalar>(number)) : code;
  };
  for (int k = 0; k < 3; ++k) {
    const V g =
        T::abs(along_a[k]) - (half_a[k] + half_b[0] * q[k][0] + half_b[1] * q[k][1] + half_b[2] * q[k][2]);
    look_at(g, g, k);
  }
  for (int k = 0; k < 3; ++k) {
    const V g =
        T::abs(along_b[k]) - (half_b[k] + half_a[0] * q[0][k] + half_a[1] * q[1][k] + half_a[2] * q[2][k]);
    look_at(g, g, 3 + k);
  }
  V apart_by = gap, edges_by = T::broadcast(static_cast<Scalar>(-huge_bound));
  const V face_lead = a.least_depth() * T::broadcast(-face_share_of_margin<Scalar>);
  const V first_edge = T::broadcast(Scalar(6));
  // Edges that are nearly parallel add no axis to those of the faces, only rounding noise.
  const V least_sine2 = T::broadcast(static_cast<Scalar>(sizeof(Scalar) == 4 ? 1e-4 : 1e-8));
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const V g =
          T::abs(along_a[i2] * r[i1][j] - along_a[i1] * r[i2][j]) -
          (half_a[i1] * q[i2][j] + half_a[i2] * q[i1][j] + half_b[j1] * q[i][j2] + half_b[j2] * q[i][j1]);
      const V sine2 = one - r[i][j] * r[i][j];
      const auto crossed = sine2 > least_sine2;
      const V unit = g / T::sqrt(crossed ? sine2 : one);
      apart_by = crossed ? T::max(apart_by, unit) : apart_by;
      const V rated = T::min(unit * T::broadcast(static_cast<Scalar>(1.05)),
                             unit * T::broadcast(static_cast<Scalar>(0.95)));
      edges_by = crossed ? T::max(edges_by, rated) : edges_by;
      const V lead = code < first_edge ? face_lead : zero;
      look_at(unit, crossed ? rated - lead : gap, 6 + 3 * i + j);
    }
  }
  const V depth = code < first_edge ? -edges_by : -gap;
  return {apart_by <= -a.least_depth() ? one : zero, depth, code};
}

/// One box of one pair.
template <class Scalar>
struct BoxPose {
  Scalar centre[3], axis[3][3], half[3];
};

/// The points of two touching boxes. A class template of T, so that each instruction set has its own code.
template <class T>
class BoxManifold {
 public:
  using Scalar = typename T::Scalar;
  using Box = BoxPose<Scalar>;

  /// `code` and `depth` as in BoxAxis. Writes at most Touch::most_points points; returns their number.
  /// `least_depth`: the least depth of a point that counts.
  static int find(const Box& a, const Box& b, int code, Scalar depth, Scalar least_depth,
                  TouchPoint* points) {
    if (code >= 6) return cross_edges(a, b, (code - 6) / 3, (code - 6) % 3, depth, points);
    const int count = code < 3 ? clip_face(a, b, code, Scalar(-1), least_depth, points)
                               : clip_face(b, a, code - 3, Scalar(1), least_depth, points);
    for (int i = 0; i < count; ++i) points[i].depth = std::min<double>(points[i].depth, depth);
    return count;
  }

 private:
  /// A corner of the clipped face: its position along the reference face's two edges, and its depth.
  struct Corner {
    Scalar u, v, depth;
  };
  static constexpr int most_corners = 8;

  static Scalar dot3(const Scalar* x, const Scalar* y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
  static int cross_edges(const Box& a, const Box& b, int i, int j, Scalar depth, TouchPoint* points);
  static int clip_face(const Box& reference, const Box& incident, int face, Scalar sign, Scalar least_depth,
                       TouchPoint* points);
  static int incident_corners(const Box& reference, const Box& incident, int face, Scalar side,
                              Corner* corners);
  static int clip(const Corner* in, int count, Scalar Corner::*place, Scalar sign, Scalar limit, Corner* out);
  static int choose(const Corner* corners, int count, int* chosen);
};

/// Writes the point half way between the two edges where they are nearest.
template <class T>
int BoxManifold<T>::cross_edges(const Box& a, const Box& b, int i, int j, Scalar depth, TouchPoint* points) {
  const Scalar *ua = a.axis[i], *ub = b.axis[j];
  Scalar normal[3] = {ua[1] * ub[2] - ua[2] * ub[1], ua[2] * ub[0] - ua[0] * ub[2],
                      ua[0] * ub[1] - ua[1] * ub[0]};
  const Scalar apart[3] = {b.centre[0] - a.centre[0], b.centre[1] - a.centre[1], b.centre[2] - a.centre[2]};
  const Scalar length = std::sqrt(dot3(normal, normal));
  const Scalar scale = (dot3(normal, apart) > 0 ? -1 : 1) / length;  // into a
  for (Scalar& x : normal) x *= scale;
  Scalar pa[3], pb[3];
  for (int k = 0; k < 3; ++k) {
    pa[k] = a.centre[k];
    pb[k] = b.centre[k];
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Scalar side_a = axis == i ? 0 : (dot3(normal, a.axis[axis]) > 0 ? -a.half[axis] : a.half[axis]);
    const Scalar side_b = axis == j ? 0 : (dot3(normal, b.axis[axis]) > 0 ? b.half[axis] : -b.half[axis]);
    for (int k = 0; k < 3; ++k) {
      pa[k] += side_a * a.axis[axis][k];
      pb[k] += side_b * b.axis[axis][k];
    }
  }
  const Scalar between[3] = {pb[0] - pa[0], pb[1] - pa[1], pb[2] - pa[2]};
  const Scalar cosine = dot3(ua, ub), along_a = dot3(ua, between), along_b = -dot3(ub, between);
  const Scalar sine2 = 1 - cosine * cosine;
  const Scalar alpha = (along_a + cosine * along_b) / sine2, beta = (cosine * along_a + along_b) / sine2;
  for (int k = 0; k < 3; ++k) {
    points->position[k] = Scalar(0.5) * (pa[k] + ua[k] * alpha + (pb[k] + ub[k] * beta));
    points->normal[k] = normal[k];
  }
  points->depth = depth;
  return 1;
}

/// Finds the face of `incident` that faces the reference face most directly, in the reference face's frame.
template <class T>
int BoxManifold<T>::incident_corners(const Box& reference, const Box& incident, int face, Scalar side,
                                     Corner* corners) {
  const int u = (face + 1) % 3, v = (face + 2) % 3;
  Scalar slope[3];
  for (int k = 0; k < 3; ++k) slope[k] = dot3(incident.axis[k], reference.axis[face]) * side;
  int most = 0;
  for (int k = 1; k < 3; ++k) {
    if (std::abs(slope[k]) > std::abs(slope[most])) most = k;
  }
  const Scalar look = slope[most] > 0 ? -1 : 1;
  Scalar centre[3];
  for (int k = 0; k < 3; ++k) {
    centre[k] =
        incident.centre[k] + look * incident.half[most] * incident.axis[most][k] - reference.centre[k];
  }
  const int e = (most + 1) % 3, f = (most + 2) % 3;
  const Scalar e_half = incident.half[e], f_half = incident.half[f];
  const Scalar signs[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (int i = 0; i < 4; ++i) {
    Scalar p[3];
    for (int k = 0; k < 3; ++k) {
      p[k] =
          centre[k] + signs[i][0] * e_half * incident.axis[e][k] + signs[i][1] * f_half * incident.axis[f][k];
    }
    corners[i] = {dot3(p, reference.axis[u]), dot3(p, reference.axis[v]),
                  reference.half[face] - side * dot3(p, reference.axis[face])};
  }
  return 4;
}

/// Keeps the part of the polygon where sign x place <= limit (Sutherland and Hodgman).
template <class T>
int BoxManifold<T>::clip(const Corner* in, int count, Scalar Corner::*place, Scalar sign, Scalar limit,
                         Corner* out) {
  int kept = 0;
  for (int i = 0; i < count && kept < most_corners; ++i) {
    const Corner &from = in[i], &to = in[i + 1 == count ? 0 : i + 1];
    const Scalar d0 = limit - sign * from.*place, d1 = limit - sign * to.*place;
    if (d0 >= 0) out[kept++] = from;
    if ((d0 < 0) != (d1 < 0) && kept < most_corners) {
      const Scalar share = d0 / (d0 - d1);
      out[kept++] = {from.u + (to.u - from.u) * share, from.v + (to.v - from.v) * share,
                     from.depth + (to.depth - from.depth) * share};
    }
  }
  return kept;
}

/// Chooses the deepest corner, the one farthest from it, and the farthest on either side of the line between
/// them: these four span nearly the area of all.
template <class T>
int BoxManifold<T>::choose(const Corner* corners, int count, int* chosen) {
  if (count <= Touch::most_points) {
    for (int i = 0; i < count; ++i) chosen[i] = i;
    return count;
  }
  int deepest = 0;
  for (int i = 1; i < count; ++i) {
    if (corners[i].depth > corners[deepest].depth) deepest = i;
  }
  const Spread<T> spread = Spread<T>::from(deepest, count, [&](int i) {
    return typename Spread<T>::Place{corners[i].u, corners[i].v};
  });
  int kept = 0;
  chosen[kept++] = deepest;
  if (spread.farthest != deepest) chosen[kept++] = spread.farthest;
  if (spread.area_left > 0) chosen[kept++] = spread.left;
  if (spread.area_right < 0) chosen[kept++] = spread.right;
  return kept;
}

/// `sign`: the normal into a is sign times the outward normal of the reference face.
template <class T>
int BoxManifold<T>::clip_face(const Box& reference, const Box& incident, int face, Scalar sign,
                              Scalar least_depth, TouchPoint* points) {
  const int u = (face + 1) % 3, v = (face + 2) % 3;
  Scalar along = 0;
  for (int k = 0; k < 3; ++k) along += (incident.centre[k] - reference.centre[k]) * reference.axis[face][k];
  const Scalar side = along > 0 ? 1 : -1;
  Corner first[most_corners], second[most_corners];
  int count = incident_corners(reference, incident, face, side, first);
  count = clip(first, count, &Corner::u, 1, reference.half[u], second);
  count = clip(second, count, &Corner::u, -1, reference.half[u], first);
  count = clip(first, count, &Corner::v, 1, reference.half[v], second);
  count = clip(second, count, &Corner::v, -1, reference.half[v], first);
  int deep = 0;
  for (int i = 0; i < count; ++i) {
    if (first[i].depth >= least_depth) second[deep++] = first[i];
  }
  int chosen[Touch::most_points];
  const int kept = choose(second, deep, chosen);
  for (int i = 0; i < kept; ++i) {
    const Corner& corner = second[chosen[i]];
    const Scalar height = side * (reference.half[face] - Scalar(0.5) * corner.depth);
    for (int k = 0; k < 3; ++k) {
      points[i].position[k] = reference.centre[k] + corner.u * reference.axis[u][k] +
                              corner.v * reference.axis[v][k] + height * reference.axis[face][k];
      points[i].normal[k] = sign * side * reference.axis[face][k];
    }
    points[i].depth = corner.depth;
  }
  return kept;
}

}  // namespace pbmpi::solver
