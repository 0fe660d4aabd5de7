/// The geoms of a pack in lanes: where they are now, and their bounding boxes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/geometry.h"
#include "solver/layout/body_lanes.h"
#include "solver/layout/lane_place.h"

namespace pbmpi::solver {

/// A column of numbers, one for each geom. It is stored as vectors, since std::vector of plain numbers is a
/// type that the code of all instruction sets shares.
template <class T>
class GeomColumn {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  void resize(int num_chunks) { chunks_.assign(static_cast<std::size_t>(num_chunks), {T::broadcast(0)}); }
  V& chunk(int i) { return chunks_[static_cast<std::size_t>(i)].values; }
  const V& chunk(int i) const { return chunks_[static_cast<std::size_t>(i)].values; }
  Scalar* data() { return reinterpret_cast<Scalar*>(chunks_.data()); }
  const Scalar* data() const { return reinterpret_cast<const Scalar*>(chunks_.data()); }
  PBMPI_LANES V gather(const std::int32_t* index) const { return T::gather(data(), index); }
  /// num_lanes consecutive geoms, starting at any geom.
  PBMPI_LANES V from(int geom) const { return T::load(data() + geom); }

 private:
  struct alignas(sizeof(V)) Chunk {
    V values;
  };
  std::vector<Chunk> chunks_;
};

template <class T>
class GeomLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  using Column = GeomColumn<T>;

  /// `num_geoms`: in all worlds; the columns are longer by a chunk, so that from() may read past the end.
  explicit GeomLanes(int num_geoms);
  /// `margin_m`: its world's PackedWorld::contact_margin_m.
  void set(int index, const model::Geom& geom, LanePlace body, double margin_m);

  /// Updates poses and boxes of the geoms in these chunks of num_lanes columns, from the poses of the bodies.
  void update(std::span<const int> chunks, const BodyLanes<T>& bodies);

  Column position[3];             ///< world frame
  Column rotation[9];             ///< by rows; unset for a sphere at its body's centre
  Column box_min[3], box_max[3];  ///< with the margin, a little larger than needed; a plane's is empty
  /// Half sides of a box, half length (z) of a capsule or cylinder; 0 for the other shapes.
  Column half[3];
  Column radius;  ///< of a sphere, capsule or cylinder
  Column margin;

 private:
  struct alignas(sizeof(V)) Chunk {
    std::int32_t body[T::num_lanes];  ///< index into the bodies' lanes
    Vec3L<V> local_position;
    Mat3L<V> local_rotation;
    V ball;      ///< radius of a sphere or capsule
    V disc;      ///< radius of a cylinder
    V infinite;  ///< 1 for a plane
    bool turns;  ///< is any geom other than a sphere at its body's centre?
  };

  void update_chunk(int i, const BodyLanes<T>& bodies);

  std::vector<Chunk> chunks_;
};

/// One geom of each lane's pair.
template <class T>
struct GeomSide {
  using V = typename T::V;
  using L3 = Vec3L<V>;

  const GeomLanes<T>* geoms;
  const std::int32_t* index;  ///< [num_lanes]

  PBMPI_LANES L3 centre() const {
    return {geoms->position[0].gather(index), geoms->position[1].gather(index),
            geoms->position[2].gather(index)};
  }
  /// The geom's own axis k in the world frame.
  PBMPI_LANES L3 axis(int k) const {
    return {geoms->rotation[k].gather(index), geoms->rotation[3 + k].gather(index),
            geoms->rotation[6 + k].gather(index)};
  }
  PBMPI_LANES V half(int k) const { return geoms->half[k].gather(index); }
  PBMPI_LANES V radius() const { return geoms->radius.gather(index); }
  /// The least depth at which geoms have a contact; negative for a gap.
  PBMPI_LANES V least_depth() const { return -geoms->margin.gather(index); }
};

template <class T>
GeomLanes<T>::GeomLanes(int num_geoms) : chunks_(static_cast<std::size_t>(num_geoms / T::num_lanes + 1)) {
  const int num_chunks = static_cast<int>(chunks_.size()) + 1;
  for (Column& column : position) column.resize(num_chunks);
  for (Column& column : rotation) column.resize(num_chunks);
  for (Column& column : half) column.resize(num_chunks);
  for (Column& column : box_min) column.resize(num_chunks);
  for (Column& column : box_max) column.resize(num_chunks);
  radius.resize(num_chunks);
  margin.resize(num_chunks);
  for (Chunk& chunk : chunks_) {  // unused lanes get empty boxes
    chunk = Chunk{};
    chunk.infinite = T::broadcast(1);
  }
}

template <class T>
void GeomLanes<T>::set(int index, const model::Geom& geom, LanePlace body, double margin_m) {
  Chunk& chunk = chunks_[static_cast<std::size_t>(index / T::num_lanes)];
  const int lane = index % T::num_lanes;
  chunk.body[lane] = BodyLanes<T>::body_index(body.slot, body.lane);
  chunk.turns |= !geometry::is_ball(geom);
  const auto scalar = [](double value) { return static_cast<Scalar>(value); };
  T::set(chunk.local_position.x, lane, scalar(geom.local.position.x()));
  T::set(chunk.local_position.y, lane, scalar(geom.local.position.y()));
  T::set(chunk.local_position.z, lane, scalar(geom.local.position.z()));
  double r[9];
  const model::Quat& q = geom.local.orientation;
  geometry::to_rotation(q.w, q.x, q.y, q.z, r);
  V* rotation_rows = &chunk.local_rotation.row0.x;
  for (int i = 0; i < 9; ++i) T::set(rotation_rows[i], lane, scalar(r[i]));
  const geometry::Extent extent = geometry::extent_of(geom);
  for (std::size_t k = 0; k < 3; ++k) half[k].data()[index] = scalar(extent.half.data()[k]);
  radius.data()[index] = scalar(extent.ball + extent.disc);
  margin.data()[index] = scalar(margin_m);
  T::set(chunk.ball, lane, scalar(extent.ball));
  T::set(chunk.disc, lane, scalar(extent.disc));
  T::set(chunk.infinite, lane, scalar(geom.shape == model::Shape::plane ? 1 : 0));
}

template <class T>
void GeomLanes<T>::update(std::span<const int> chunks, const BodyLanes<T>& bodies) {
  for (const int i : chunks) update_chunk(i, bodies);
}

template <class T>
void GeomLanes<T>::update_chunk(int i, const BodyLanes<T>& bodies) {
  const Chunk& chunk = chunks_[static_cast<std::size_t>(i)];
  constexpr std::size_t first_centre = offsetof(BodyLane<V>, position);
  constexpr std::size_t first_rotation = offsetof(BodyLane<V>, rotation);
  const Vec3L<V>& p = chunk.local_position;
  const Mat3L<V>& m = chunk.local_rotation;
  const V zero = T::broadcast(0);
  const auto at = [&](std::size_t first, int element) {
    return bodies.gather_member(first + static_cast<std::size_t>(element) * sizeof(V), chunk.body);
  };
  for (int k = 0; k < 3; ++k) {
    V centre = at(first_centre, k), reach = chunk.ball;
    if (chunk.turns) {
      const Vec3L<V> r{at(first_rotation, 3 * k), at(first_rotation, 3 * k + 1),
                       at(first_rotation, 3 * k + 2)};
      centre += dot(r, p);
      const V x = r.x * m.row0.x + r.y * m.row1.x + r.z * m.row2.x;
      const V y = r.x * m.row0.y + r.y * m.row1.y + r.z * m.row2.y;
      const V z = r.x * m.row0.z + r.y * m.row1.z + r.z * m.row2.z;
      rotation[3 * k].chunk(i) = x;
      rotation[3 * k + 1].chunk(i) = y;
      rotation[3 * k + 2].chunk(i) = z;
      const V rim = chunk.disc * T::sqrt(T::max(T::broadcast(1) - z * z, zero));
      reach = T::abs(x) * half[0].chunk(i) + T::abs(y) * half[1].chunk(i) + T::abs(z) * half[2].chunk(i) +
              chunk.ball + rim;
    }
    position[k].chunk(i) = centre;
    // Rounding must not separate boxes of geoms that the narrow phase finds touching.
    const V slack =
        (T::abs(centre) + reach) * T::broadcast(static_cast<Scalar>(sizeof(Scalar) == 4 ? 1e-6 : 1e-14));
    const V far = T::broadcast(static_cast<Scalar>(huge_bound));
    reach += margin.chunk(i);
    box_min[k].chunk(i) = chunk.infinite > zero ? far : centre - reach - slack;
    box_max[k].chunk(i) = chunk.infinite > zero ? -far : centre + reach + slack;
  }
}

}  // namespace pbmpi::solver
