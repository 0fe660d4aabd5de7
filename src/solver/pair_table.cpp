#include "solver/pair_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pbmpi::solver {
namespace {

using model::Shape;

/// Kinds name their shapes in this order.
int rank_of(Shape shape, Shape other) {
  if (shape == Shape::plane) return 3;
  if (shape == Shape::box) return 2;
  if (shape == Shape::sphere) return other == Shape::capsule ? 1 : 0;
  return 0;  // capsule, cylinder
}

PairKind kind_of(Shape a, Shape b) {
  switch (a) {
    case Shape::sphere:
      if (b == Shape::plane) return PairKind::sphere_plane;
      if (b == Shape::sphere) return PairKind::sphere_sphere;
      if (b == Shape::box) return PairKind::sphere_box;
      break;
    case Shape::capsule:
      if (b == Shape::plane) return PairKind::capsule_plane;
      if (b == Shape::sphere) return PairKind::capsule_sphere;
      if (b == Shape::capsule) return PairKind::capsule_capsule;
      if (b == Shape::box) return PairKind::capsule_box;
      break;
    case Shape::box:
      if (b == Shape::plane) return PairKind::box_plane;
      if (b == Shape::box) return PairKind::box_box;
      break;
    case Shape::cylinder:
      if (b == Shape::plane) return PairKind::cylinder_plane;
      break;
    case Shape::plane:
      break;
  }
  return PairKind::other;
}

}  // namespace

void PoseCache::grow(int num_bodies) { poses_.resize(static_cast<std::size_t>(num_bodies)); }

bool is_finite(const model::BodyPose& pose) {
  double sum = 0;  // NaN and infinity survive a sum
  for (const double value : pose.position) sum += value;
  for (const double value : pose.rotation) sum += value;
  return std::isfinite(sum);
}

PairTable::PairTable(std::span<const PackedWorld> worlds, const GeomOrder& order) : order_(&order) {
  for (const PackedWorld& world : worlds) {
    models_.push_back(world.model);
    kernels_ = kernels_ && world.lanes_collide;
  }
}

void PairTable::clear() {
  world_begin_.assign(models_.size() + 1, 0);
  pairs_.clear();
  for (PairColumn& column : columns_) {
    column.a.clear();
    column.b.clear();
    column.touch.clear();
  }
}

void PairTable::start_world(int world) {
  world_ = world;
  world_begin_[static_cast<std::size_t>(world)] = static_cast<int>(pairs_.size());
}

void PairTable::add(int first, int second) {
  pairs_.push_back({std::min(first, second), std::max(first, second)});
}

void PairTable::add_all(BroadPhase& broad_phase, std::span<const model::BodyPose> poses,
                        const AwakeGeoms* awake) {
  std::vector<model::GeomPair> pairs;
  broad_phase.find_pairs(poses, pairs);
  if (awake != nullptr) awake->drop_asleep(pairs);
  pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
}

void PairTable::finish_world() {
  const auto begin = pairs_.begin() + world_begin_[static_cast<std::size_t>(world_)];
  if (!std::is_sorted(begin, pairs_.end())) std::sort(begin, pairs_.end());
  const model::Model& model = *models_[static_cast<std::size_t>(world_)];
  for (auto pair = begin; pair != pairs_.end(); ++pair) {
    int a = pair->first, b = pair->second;
    const Shape first = model.geoms[static_cast<std::size_t>(a)].shape;
    const Shape second = model.geoms[static_cast<std::size_t>(b)].shape;
    const bool swap = rank_of(first, second) > rank_of(second, first);
    if (swap) std::swap(a, b);
    const PairKind kind =
        !kernels_ ? PairKind::other : (swap ? kind_of(second, first) : kind_of(first, second));
    PairColumn& column = columns_[static_cast<std::size_t>(kind)];
    column.a.push_back(order_->column(world_, a));
    column.b.push_back(order_->column(world_, b));
    column.touch.push_back(static_cast<std::int32_t>(pair - pairs_.begin()));
  }
  world_begin_[static_cast<std::size_t>(world_) + 1] = static_cast<int>(pairs_.size());
}

void PairTable::pad(int num_lanes) {
  touches_.assign(pairs_.size(), {});
  if (points_.size() < pairs_.size() * Touch::most_points) points_.resize(pairs_.size() * Touch::most_points);
  for (PairColumn& column : columns_) {
    column.count = static_cast<int>(column.a.size());
    while (column.a.size() % static_cast<std::size_t>(num_lanes) != 0) {
      column.a.push_back(column.a.back());
      column.b.push_back(column.b.back());
      column.touch.push_back(column.touch.back());
    }
  }
  const PairColumn& others = column(PairKind::other);
  for (int i = 0; i < others.count; ++i)
    touches_[static_cast<std::size_t>(others.touch[static_cast<std::size_t>(i)])].to_fallback = true;
}

void PairTable::append(int world, const model::GeomPair& pair, const Touch& touch,
                       std::vector<model::Contact>& contacts) const {
  const model::Model& model = *models_[static_cast<std::size_t>(world)];
  const model::Geom& first = model.geoms[static_cast<std::size_t>(pair.first)];
  const model::Geom& second = model.geoms[static_cast<std::size_t>(pair.second)];
  const bool kernel_swapped = rank_of(first.shape, second.shape) > rank_of(second.shape, first.shape);
  const bool first_is_a = first.body != model::no_body;  // a must be a real body
  const model::Material material = model::combined(first.material, second.material);
  model::Contact contact;
  contact.body_a = first_is_a ? first.body : second.body;
  contact.body_b = first_is_a ? second.body : first.body;
  contact.mu = material.mu;
  contact.restitution = material.restitution;
  contact.geoms = pair;
  const double sign = kernel_swapped == first_is_a ? -1 : 1;
  for (int i = 0; i < std::min<int>(touch.num_points, model.contact_law.max_per_pair); ++i) {
    const TouchPoint& point = points_[static_cast<std::size_t>(touch.first_point + i)];
    contact.position = model::Vec3(point.position);
    contact.normal = sign * model::Vec3(point.normal);
    contact.depth = point.depth;
    contacts.push_back(contact);
  }
}

}  // namespace pbmpi::solver
