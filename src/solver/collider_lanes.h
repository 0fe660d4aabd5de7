/// Collision detection of a pack: boxes, candidate pairs, kernels, contacts in canonical order.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "solver/broad_phase.h"
#include "solver/may_touch_table.h"
#include "solver/narrow_lanes.h"
#include "solver/pack.h"
#include "solver/world_lanes.h"

namespace pbmpi::solver {

template <class T>
class ColliderLanes {
 public:
  using V = typename T::V;
  using Scalar = typename T::Scalar;

  ColliderLanes(std::span<const PackedWorld> worlds, const WorldLanes<T>& lanes);

  /// The contacts of each world, in canonical order: contacts[num_worlds].
  void collide(const WorldLanes<T>& lanes, std::span<std::vector<model::Contact>> contacts);
  /// The contacts of given pairs of one world, pairs in canonical order; appended.
  void collide_pairs(const WorldLanes<T>& lanes, int world, std::span<const model::GeomPair> pairs,
                     std::vector<model::Contact>& contacts);

 private:
  /// Above so many geoms sorting beats testing all boxes against all.
  static constexpr int most_tested_geoms = 1024;

  struct World {
    const model::Model* model = nullptr;
    model::NarrowPhase* fallback = nullptr;
    int first_geom = 0;
    std::unique_ptr<MayTouchTable> may_touch;  ///< none in a world of many geoms, which sorts
    std::unique_ptr<BroadPhase> sorting;
  };

  static int count_geoms(std::span<const PackedWorld> worlds);

  void find_pairs(const WorldLanes<T>& lanes, int world);
  void test_solid(const World& world, int geom);
  void test_plane(const World& world, int geom);
  void add_pairs(const World& world, int geom, int first, unsigned touching);
  void run_kernels();
  void take_contacts(const WorldLanes<T>& lanes, int world, std::vector<model::Contact>& contacts);

  std::vector<World> worlds_;
  GeomLanes<T> geoms_;
  PairTable table_;
  PoseCache poses_;
};

template <class T>
int ColliderLanes<T>::count_geoms(std::span<const PackedWorld> worlds) {
  std::size_t count = 0;
  for (const PackedWorld& world : worlds) count += world.model->geoms.size();
  return static_cast<int>(count);
}

template <class T>
ColliderLanes<T>::ColliderLanes(std::span<const PackedWorld> worlds, const WorldLanes<T>& lanes)
    : geoms_(count_geoms(worlds)), table_(worlds) {
  int next = 0;
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    const model::Model& model = *worlds[w].model;
    World& world = worlds_.emplace_back();
    world.model = &model;
    world.fallback = worlds[w].fallback;
    world.first_geom = next;
    for (const model::Geom& geom : model.geoms)
      geoms_.set(next++, geom, lanes.body_place(static_cast<int>(w), geom.body));
    if (model.geoms.size() <= most_tested_geoms) {
      world.may_touch = std::make_unique<MayTouchTable>(model);
    } else {
      world.sorting = std::make_unique<BroadPhase>(model);
    }
  }
}

template <class T>
void ColliderLanes<T>::collide(const WorldLanes<T>& lanes, std::span<std::vector<model::Contact>> contacts) {
  geoms_.update(lanes.bodies);
  table_.clear();
  const int num_worlds = static_cast<int>(worlds_.size());
  for (int world = 0; world < num_worlds; ++world) find_pairs(lanes, world);
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
  geoms_.update(lanes.bodies);
  table_.clear();
  table_.start_world(world);
  for (const model::GeomPair& pair : pairs) table_.add(pair.first, pair.second);
  table_.finish_world();
  run_kernels();
  take_contacts(lanes, world, contacts);
}

template <class T>
void ColliderLanes<T>::find_pairs(const WorldLanes<T>& lanes, int index) {
  const World& world = worlds_[static_cast<std::size_t>(index)];
  table_.start_world(index);
  if (world.sorting) {
    lanes.poses(index, poses_.all(world.model->num_bodies()));
    table_.add_all(*world.sorting, poses_.all(world.model->num_bodies()));
  } else {
    const int count = static_cast<int>(world.model->geoms.size());
    for (int geom = 0; geom < count; ++geom) {
      if (world.model->geoms[static_cast<std::size_t>(geom)].shape == model::Shape::plane) {
        test_plane(world, geom);
      } else {
        test_solid(world, geom);
      }
    }
  }
  table_.finish_world();
}

template <class T>
void ColliderLanes<T>::add_pairs(const World& world, int geom, int first, unsigned touching) {
  constexpr unsigned all = T::num_lanes == 32 ? ~0u : (1u << T::num_lanes) - 1;
  for (unsigned bits = touching & world.may_touch->bits(geom, first) & all; bits != 0; bits &= bits - 1)
    table_.add(geom, first + __builtin_ctz(bits));
}

template <class T>
void ColliderLanes<T>::test_solid(const World& world, int geom) {
  const V zero = T::broadcast(0), one = T::broadcast(1);
  V low[3], high[3];
  for (int k = 0; k < 3; ++k) {
    low[k] = T::broadcast(geoms_.box_min[k].data()[world.first_geom + geom]);
    high[k] = T::broadcast(geoms_.box_max[k].data()[world.first_geom + geom]);
  }
  const int count = static_cast<int>(world.model->geoms.size());
  for (int first = (geom + 1) / T::num_lanes * T::num_lanes; first < count; first += T::num_lanes) {
    V overlap = one;
    for (int k = 0; k < 3; ++k) {
      overlap = geoms_.box_min[k].from(world.first_geom + first) <= high[k] ? overlap : zero;
      overlap = low[k] <= geoms_.box_max[k].from(world.first_geom + first) ? overlap : zero;
    }
    add_pairs(world, geom, first, T::bits(overlap));
  }
}

template <class T>
void ColliderLanes<T>::test_plane(const World& world, int geom) {
  const int plane = world.first_geom + geom;
  Scalar normal[3], offset = 0;
  for (int k = 0; k < 3; ++k) {
    normal[k] = geoms_.rotation[3 * k + 2].data()[plane];
    offset += normal[k] * geoms_.position[k].data()[plane];
  }
  const V zero = T::broadcast(0), one = T::broadcast(1);
  const int count = static_cast<int>(world.model->geoms.size());
  for (int first = 0; first < count; first += T::num_lanes) {
    V height = zero;
    for (int k = 0; k < 3; ++k) {
      const auto& nearest = normal[k] > 0 ? geoms_.box_min[k] : geoms_.box_max[k];
      height += nearest.from(world.first_geom + first) * T::broadcast(normal[k]);
    }
    add_pairs(world, geom, first, T::bits(height <= T::broadcast(offset) ? one : zero));
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
  table_.append_contacts(index, contacts, [&](const model::GeomPair& pair) {
    const std::span<model::BodyPose> poses = poses_.all(world.model->num_bodies());
    for (const int geom : {pair.first, pair.second}) {
      const int body = world.model->geoms[static_cast<std::size_t>(geom)].body;
      if (body == model::no_body) continue;
      poses[static_cast<std::size_t>(body)] = lanes.pose(index, body);
      if (!is_finite(poses[static_cast<std::size_t>(body)])) return;  // the world is lost, and reports so
    }
    world.fallback->collide(poses, {&pair, 1}, contacts);
  });
}

}  // namespace pbmpi::solver
