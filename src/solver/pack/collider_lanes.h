/// Collision detection of a pack: boxes, candidate pairs, kernels, contacts in canonical order.
#pragma once

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/box.h"
#include "geometry/seams.h"
#include "solver/collide/awake_geoms.h"
#include "solver/collide/broad_phase.h"
#include "solver/collide/group_boxes.h"
#include "solver/collide/may_touch_table.h"
#include "solver/collide/narrow_lanes.h"
#include "solver/pack/pack.h"
#include "solver/pack/world_lanes.h"

namespace pbmpi::solver {

template <class T>
class ColliderLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  /// `sleeping`: looks only for contacts that have an awake body.
  ColliderLanes(std::span<const PackedWorld> worlds, const WorldLanes<T>& lanes, bool sleeping);

  /// Takes in which joints of a world are broken from now on (State::broken_in).
  void set_broken(int world, std::span<const std::int32_t> broken_in) {
    find_touchable(worlds_[static_cast<std::size_t>(world)], broken_in);
  }
  /// Call it when sleeping bodies have been moved from outside.
  void forget_boxes() { boxes_known_ = false; }

  /// Finds the contacts of each world, in canonical order: contacts[num_worlds].
  void collide(const WorldLanes<T>& lanes, std::span<std::vector<model::Contact>> contacts);
  /// Appends the contacts of given pairs of one world, pairs in canonical order.
  void collide_pairs(const WorldLanes<T>& lanes, int world, std::span<const model::GeomPair> pairs,
                     std::vector<model::Contact>& contacts);

 private:
  /// Above most_ungrouped_geoms groups of geoms are tested before their geoms; above most_tested_geoms geoms
  /// have a BroadPhase.
  static constexpr int most_ungrouped_geoms = 96;
  static constexpr int most_tested_geoms = GroupBoxes<T>::group_size * GroupBoxes<T>::most_groups;

  struct World {
    const model::Model* model = nullptr;
    model::NarrowPhase* fallback = nullptr;
    std::span<const int> geoms;                    ///< swept
    int first_column = 0;                          ///< of the swept geoms
    std::unique_ptr<MayTouchTable> may_touch;      ///< of the swept geoms; none if there are too many
    std::unique_ptr<BroadPhase> broad_phase;       ///< of the swept geoms, if there are too many
    std::unique_ptr<const geometry::Seams> seams;  ///< none where no geoms touch that keep together
    double margin_m = 0;
    bool lanes_collide = true;
    std::optional<AwakeGeoms> awake;  ///< none without the pass "sleeping"
  };

  static void find_touchable(World& world, std::span<const std::int32_t> broken_in);
  void update_boxes(const WorldLanes<T>& lanes);
  void find_awake(const WorldLanes<T>& lanes);
  void find_pairs(int world);
  /// The boxes of a world's swept geoms, valid until the next call.
  std::span<const geometry::Box> boxes_of(const World& world);
  /// Tests the i-th swept geom against all that come after it.
  void test_solid(const World& world, int i);
  /// Tests the i-th swept geom against those of [first, last) only; `box` is its own, in all lanes.
  PBMPI_LANES void test_range(const World& world, int i, const BoxLanes<T>& box, int first, int last);
  void test_plane(const World& world, int i);
  /// Tests the i-th swept geom, which sleeps or is static, against the awake geoms after it.
  void test_sleeper(const World& world, int i);
  PBMPI_LANES void add_pairs(const World& world, int i, int first, unsigned touching);
  void run_kernels();
  void take_contacts(const WorldLanes<T>& lanes, int world, std::vector<model::Contact>& contacts);

  GeomOrder order_;
  std::vector<World> worlds_;
  GeomLanes<T> geoms_;
  GroupBoxes<T> groups_;           ///< of the current world
  std::vector<int> swept_chunks_;  ///< of geoms_
  std::vector<int> pair_chunks_;   ///< chunks of given pairs
  PairTable table_;
  PoseCache poses_;
  bool sleeping_;
  bool boxes_known_ = false;       ///< are the boxes of all sleeping geoms up to date?
  long awake_revision_ = -1;       ///< revision of the bodies for which World::awake holds
  std::vector<int> awake_chunks_;  ///< of geoms_
};

template <class T>
ColliderLanes<T>::ColliderLanes(std::span<const PackedWorld> worlds, const WorldLanes<T>& lanes,
                                bool sleeping)
    : order_(worlds),
      geoms_(order_.num_columns()),
      swept_chunks_(order_.swept_chunks(T::num_lanes)),
      table_(worlds, order_),
      sleeping_(sleeping) {
  for (int w = 0; w < static_cast<int>(worlds.size()); ++w) {
    const PackedWorld& packed = worlds[static_cast<std::size_t>(w)];
    const model::Model& model = *packed.model;
    World& world = worlds_.emplace_back();
    world.model = &model;
    world.fallback = packed.fallback;
    world.seams = geometry::Seams::find(model);
    world.margin_m = packed.contact_margin_m;
    world.lanes_collide = packed.lanes_collide;
    world.geoms = order_.swept(w);
    world.first_column = order_.first(w);
    if (sleeping) world.awake.emplace(model, world.geoms, T::num_lanes);
    for (std::size_t geom = 0; geom < model.geoms.size(); ++geom) {
      geoms_.set(order_.column(w, static_cast<int>(geom)), model.geoms[geom],
                 lanes.places.body(w, model.geoms[geom].body), packed.contact_margin_m);
    }
    find_touchable(world, {});
  }
}

template <class T>
void ColliderLanes<T>::find_touchable(World& world, std::span<const std::int32_t> broken_in) {
  if (world.geoms.size() <= most_tested_geoms) {
    world.may_touch = std::make_unique<MayTouchTable>(*world.model, world.geoms, broken_in);
  } else {
    if (!world.broad_phase) world.broad_phase = std::make_unique<BroadPhase>(*world.model, world.geoms);
    world.broad_phase->set_broken(broken_in);
  }
}

template <class T>
void ColliderLanes<T>::collide(const WorldLanes<T>& lanes, std::span<std::vector<model::Contact>> contacts) {
  update_boxes(lanes);
  table_.clear();
  const int num_worlds = static_cast<int>(worlds_.size());
  for (int world = 0; world < num_worlds; ++world) find_pairs(world);
  run_kernels();
  for (int world = 0; world < num_worlds; ++world) {
    contacts[static_cast<std::size_t>(world)].clear();
    take_contacts(lanes, world, contacts[static_cast<std::size_t>(world)]);
  }
}

template <class T>
void ColliderLanes<T>::collide_pairs(const WorldLanes<T>& lanes, int world,
                                     std::span<const model::GeomPair> pairs,
                                     std::vector<model::Contact>& contacts) {
  order_.find_chunks(world, pairs, T::num_lanes, pair_chunks_);
  geoms_.update(pair_chunks_, lanes.bodies);
  table_.clear();
  table_.start_world(world);
  for (const model::GeomPair& pair : pairs) table_.add(pair.first, pair.second);
  table_.finish_world();
  run_kernels();
  take_contacts(lanes, world, contacts);
}

/// Updates only awake geoms' boxes if it can: those of sleeping geoms do not change.
template <class T>
void ColliderLanes<T>::update_boxes(const WorldLanes<T>& lanes) {
  if (sleeping_) find_awake(lanes);
  geoms_.update(sleeping_ && boxes_known_ ? awake_chunks_ : swept_chunks_, lanes.bodies);
  boxes_known_ = true;
}

template <class T>
void ColliderLanes<T>::find_awake(const WorldLanes<T>& lanes) {
  if (awake_revision_ == lanes.awake().revision()) return;
  awake_revision_ = lanes.awake().revision();
  awake_chunks_.clear();
  for (std::size_t w = 0; w < worlds_.size(); ++w) {
    worlds_[w].awake->find(lanes.awake(), static_cast<int>(w));
    worlds_[w].awake->add_chunks(worlds_[w].first_column, awake_chunks_);
  }
}

template <class T>
std::span<const geometry::Box> ColliderLanes<T>::boxes_of(const World& world) {
  const std::span<geometry::Box> boxes = table_.boxes(world.geoms.size());
  for (std::size_t k = 0; k < 3; ++k) {
    const Scalar* low = geoms_.box_min[k].data() + world.first_column;
    const Scalar* high = geoms_.box_max[k].data() + world.first_column;
    for (std::size_t i = 0; i < world.geoms.size(); ++i) {
      boxes[i].min[k] = low[i];
      boxes[i].max[k] = high[i];
    }
  }
  return boxes;
}

template <class T>
void ColliderLanes<T>::find_pairs(int index) {
  const World& world = worlds_[static_cast<std::size_t>(index)];
  table_.start_world(index);
  if (world.awake && world.awake->chunks().empty()) {
    // nothing can begin to touch
  } else if (world.broad_phase) {
    table_.add_all(*world.broad_phase, boxes_of(world), world.awake ? &*world.awake : nullptr);
  } else {
    const int count = static_cast<int>(world.geoms.size());
    if (count > most_ungrouped_geoms) groups_.update(geoms_, world.first_column, count);
    for (int i = 0; i < count; ++i) {
      if (world.may_touch->is_plane(i)) {
        test_plane(world, i);
      } else if (world.awake && !world.awake->contains(i)) {
        test_sleeper(world, i);
      } else {
        test_solid(world, i);
      }
    }
  }
  table_.finish_world();
}

template <class T>
PBMPI_LANES void ColliderLanes<T>::add_pairs(const World& world, int i, int first, unsigned touching) {
  const std::uint32_t pairs = touching & world.may_touch->bits(i, first) & ((2u << (T::num_lanes - 1)) - 1);
  if (pairs != 0) table_.add(world.geoms[static_cast<std::size_t>(i)], world.geoms.data() + first, pairs);
}

template <class T>
void ColliderLanes<T>::test_solid(const World& world, int i) {
  constexpr int group_size = GroupBoxes<T>::group_size;
  const BoxLanes<T> box(geoms_.box_min, geoms_.box_max, world.first_column + i);
  const int count = static_cast<int>(world.geoms.size());
  if (count <= most_ungrouped_geoms) {
    test_range(world, i, box, i + 1, count);
    return;
  }
  for (std::uint64_t near = groups_.overlapping(box, i / group_size); near != 0; near &= near - 1) {
    const int first = std::countr_zero(near) * group_size;
    test_range(world, i, box, std::max(first, i + 1), std::min(first + group_size, count));
  }
}

template <class T>
PBMPI_LANES void ColliderLanes<T>::test_range(const World& world, int i, const BoxLanes<T>& box, int first,
                                              int last) {
  for (int chunk = first & -T::num_lanes; chunk < last; chunk += T::num_lanes)
    add_pairs(world, i, chunk, box.overlapping(geoms_.box_min, geoms_.box_max, world.first_column + chunk));
}

template <class T>
void ColliderLanes<T>::test_sleeper(const World& world, int i) {
  const BoxLanes<T> box(geoms_.box_min, geoms_.box_max, world.first_column + i);
  for (const int first : world.awake->chunks()) {
    if (first + T::num_lanes <= i) continue;
    const unsigned near = box.overlapping(geoms_.box_min, geoms_.box_max, world.first_column + first);
    add_pairs(world, i, first, near & world.awake->bits(first));
  }
}

template <class T>
void ColliderLanes<T>::test_plane(const World& world, int i) {
  const int plane = world.first_column + i;
  Scalar normal[3], offset = 0;
  for (int k = 0; k < 3; ++k) {
    normal[k] = geoms_.rotation[3 * k + 2].data()[plane];
    offset += normal[k] * geoms_.position[k].data()[plane];
  }
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const int count = static_cast<int>(world.geoms.size());
  for (int first = 0; first < count; first += T::num_lanes) {
    V height = zero;
    for (int k = 0; k < 3; ++k) {
      const auto& nearest = normal[k] > 0 ? geoms_.box_min[k] : geoms_.box_max[k];
      height += nearest.from(world.first_column + first) * T::broadcast(normal[k]);
    }
    const unsigned awake = world.awake ? world.awake->bits(first) : ~0u;
    add_pairs(world, i, first, T::bits(height <= T::broadcast(offset) ? one : zero) & awake);
  }
}

template <class T>
void ColliderLanes<T>::run_kernels() {
  table_.pad(T::num_lanes);
  NarrowLanes<T>::collide(geoms_, table_);
}

template <class T>
void ColliderLanes<T>::take_contacts(const WorldLanes<T>& lanes, int index,
                                     std::vector<model::Contact>& contacts) {
  const World& world = worlds_[static_cast<std::size_t>(index)];
  const auto collide_otherwise = [&](const model::GeomPair& pair) {
    const std::span<model::BodyPose> poses = poses_.all(world.model->num_bodies());
    for (const int geom : {pair.first, pair.second}) {
      const int body = world.model->geoms[static_cast<std::size_t>(geom)].body;
      if (body == model::no_body) continue;
      poses[static_cast<std::size_t>(body)] = lanes.pose(index, body);
      if (!is_finite(poses[static_cast<std::size_t>(body)])) return;  // the world is lost, and reports it
    }
    world.fallback->collide(poses, {&pair, 1}, contacts);
  };
  const double least_depth = world.lanes_collide ? -world.margin_m : 0;
  const auto correct_at_seams = [&](std::size_t first) {
    if (!world.seams) return;
    world.seams->correct(
        first, least_depth, [&](int body) { return lanes.pose(index, body); }, contacts);
  };
  table_.append_contacts(index, contacts, collide_otherwise, correct_at_seams);
}

}  // namespace pbmpi::solver
