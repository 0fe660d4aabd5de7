/// The pairs of geoms that a step tests, all worlds of a pack together, and the points at which they touch.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/contact.h"
#include "model/model.h"
#include "solver/collide/awake_geoms.h"
#include "solver/collide/broad_phase.h"
#include "solver/layout/geom_order.h"
#include "solver/layout/packed_world.h"

namespace pbmpi::solver {

/// The pairs of shapes that kernels collide. The first shape named is the pair's a. `other`: shapes without a
/// kernel.
enum class PairKind {
  sphere_plane,
  capsule_plane,
  box_plane,
  cylinder_plane,
  sphere_sphere,
  capsule_sphere,
  sphere_box,
  capsule_capsule,
  capsule_box,
  box_box,
  cylinder_sphere,
  cylinder_capsule,
  cylinder_box,
  cylinder_cylinder,
  other
};
inline constexpr int num_pair_kinds = 15;

/// A point that a kernel found.
struct TouchPoint {
  double position[3];  ///< [m] world frame
  double normal[3];    ///< unit, into a
  double depth;        ///< [m]
};

/// The result for a pair: consecutive points of the table.
struct Touch {
  static constexpr int most_points = 4;
  int first_point = 0;
  short num_points = 0;
  bool to_fallback = false;  ///< no kernel collides this kind of pair
};

/// Pairs of one kind, in columns of indices into the columns of the pack's geoms. Padded to whole lanes by
/// repeating the last pair.
struct PairColumn {
  std::vector<std::int32_t> a, b, touch;  ///< [at least count, padded]
  int count = 0;                          ///< without the padding
  void make_room(std::ptrdiff_t pairs);   ///< for this many more
};

/// Memory for the poses of a world's bodies, kept from step to step.
class PoseCache {
 public:
  std::span<model::BodyPose> all(int num_bodies) {
    if (static_cast<std::size_t>(num_bodies) > poses_.size()) grow(num_bodies);
    return {poses_.data(), static_cast<std::size_t>(num_bodies)};
  }

 private:
  void grow(int num_bodies);
  std::vector<model::BodyPose> poses_;
};

/// Is every number of a pose finite?
bool is_finite(const model::BodyPose& pose);

class PairTable {
 public:
  /// The models of `worlds`, and `order`, are borrowed.
  PairTable(std::span<const PackedWorld> worlds, const GeomOrder& order);

  void clear();
  /// The pairs added from now on belong to this world; their order does not matter.
  void start_world(int world);
  /// Adds two geoms of the current world, by their indices in its model.
  void add(int first, int second);
  /// Adds `geom` with each geom of `others` whose bit is set.
  void add(int geom, const int* others, std::uint32_t bits);
  /// Memory for the boxes of a world's geoms, valid until the next call.
  std::span<geometry::Box> boxes(std::size_t count);
  /// Adds all pairs that this broad phase finds in the current world, see BroadPhase::append_pairs().
  void add_all(BroadPhase& broad_phase, std::span<const geometry::Box> boxes, const AwakeGeoms* awake);
  /// After the last pair of a world: puts its pairs in canonical order.
  void finish_world();
  /// After the last world: fills the columns up to multiples of num_lanes.
  void pad(int num_lanes);

  const PairColumn& column(PairKind kind) const { return columns_[static_cast<std::size_t>(kind)]; }
  /// Where the kernels put their results: touches at PairColumn::touch, points one after the other.
  Touch* touches() { return touches_.data(); }
  TouchPoint* points() { return points_.data(); }

  /// Appends the contacts of a world, in canonical order. `fallback(pair)` appends those of a pair
  /// without a kernel; `correct(first)` may then change those of the pair, contacts[first ...].
  template <class Fallback, class Correct>
  void append_contacts(int world, std::vector<model::Contact>& contacts, Fallback fallback,
                       Correct correct) const {
    for (int i = world_begin_[static_cast<std::size_t>(world)];
         i < world_begin_[static_cast<std::size_t>(world) + 1]; ++i) {
      const Touch& touch = touches_[static_cast<std::size_t>(i)];
      const model::GeomPair& pair = pairs_[static_cast<std::size_t>(i)];
      const std::size_t first = contacts.size();
      if (touch.to_fallback) {
        fallback(pair);
      } else if (touch.num_points > 0) {
        append(world, pair, touch, contacts);
      }
      if (contacts.size() > first) correct(first);
    }
  }

 private:
  /// What a pair needs of a geom, kept apart from the rest so that more geoms fit in the cache.
  struct GeomFacts {
    model::Shape shape;
    int body;
    model::Material material;
  };
  struct World {
    const model::Model* model = nullptr;
    std::vector<GeomFacts> geoms;
    int most_points = 0;  ///< contacts a pair
  };

  void append(int world, const model::GeomPair& pair, const Touch& touch,
              std::vector<model::Contact>& contacts) const;

  std::vector<World> worlds_;
  const GeomOrder* order_;  ///< borrowed
  bool kernels_ = true;     ///< false: all pairs are of kind `other`
  int world_ = 0;
  std::vector<geometry::Box> boxes_;
  std::vector<int> world_begin_;  ///< [worlds + 1] into pairs
  std::vector<model::GeomPair> pairs_;
  std::vector<Touch> touches_;      ///< [pairs]
  std::vector<TouchPoint> points_;  ///< at least [pairs][most_points]
  std::array<PairColumn, num_pair_kinds> columns_;
};

}  // namespace pbmpi::solver
