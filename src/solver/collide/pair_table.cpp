#include "solver/collide/pair_table.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace pbmpi::solver {
namespace {

using model::Shape;

/// How a pair of shapes is collided.
struct Pairing {
  PairKind kind = PairKind::other;
  bool swapped = false;  ///< the kernel's a is the second geom
};

constexpr std::array<std::array<Pairing, model::num_shapes>, model::num_shapes> all_pairings() {
  struct Kernel {
    Shape a, b;
    PairKind kind;
  };
  constexpr Kernel kernels[] = {{Shape::sphere, Shape::plane, PairKind::sphere_plane},
                                {Shape::capsule, Shape::plane, PairKind::capsule_plane},
                                {Shape::box, Shape::plane, PairKind::box_plane},
                                {Shape::cylinder, Shape::plane, PairKind::cylinder_plane},
                                {Shape::sphere, Shape::sphere, PairKind::sphere_sphere},
                                {Shape::capsule, Shape::sphere, PairKind::capsule_sphere},
                                {Shape::sphere, Shape::box, PairKind::sphere_box},
                                {Shape::capsule, Shape::capsule, PairKind::capsule_capsule},
                                {Shape::capsule, Shape::box, PairKind::capsule_box},
                                {Shape::box, Shape::box, PairKind::box_box},
                                {Shape::cylinder, Shape::sphere, PairKind::cylinder_sphere},
                                {Shape::cylinder, Shape::capsule, PairKind::cylinder_capsule},
                                {Shape::cylinder, Shape::box, PairKind::cylinder_box},
                                {Shape::cylinder, Shape::cylinder, PairKind::cylinder_cylinder}};
  std::array<std::array<Pairing, model::num_shapes>, model::num_shapes> all{};
  for (auto& row : all) row.fill(Pairing{});  // g++ 12 leaves the last element of `all{}` zero
  for (const Kernel& kernel : kernels) {
    const auto a = static_cast<std::size_t>(kernel.a), b = static_cast<std::size_t>(kernel.b);
    all[b][a] = {kernel.kind, true};
    all[a][b] = {kernel.kind, false};
  }
  return all;
}

const Pairing& pairing_of(Shape first, Shape second) {
  static constexpr auto all = all_pairings();
  return all[static_cast<std::size_t>(first)][static_cast<std::size_t>(second)];
}

/// Canonical order, in one comparison. (A function object, so that std::sort inlines it.)
constexpr auto comes_before = [](const model::GeomPair& p, const model::GeomPair& q) {
  const auto key = [](const model::GeomPair& pair) {
    return static_cast<std::uint64_t>(pair.first) << 32 | static_cast<std::uint32_t>(pair.second);
  };
  return key(p) < key(q);
};

/// Geoms that are swept in turn give sorted pairs, and a ground after them another sorted run.
void sort(std::vector<model::GeomPair>::iterator begin, std::vector<model::GeomPair>::iterator end) {
  const auto first_row = std::is_sorted_until(begin, end, comes_before);
  if (first_row == end) return;
  if (std::is_sorted(first_row, end, comes_before)) {
    std::inplace_merge(begin, first_row, end, comes_before);
  } else {
    std::sort(begin, end, comes_before);
  }
}

}  // namespace

void PairColumn::make_room(std::ptrdiff_t pairs) {
  const auto wanted = static_cast<std::size_t>(count + pairs);
  if (a.size() >= wanted) return;
  for (std::vector<std::int32_t>* indices : {&a, &b, &touch}) indices->resize(2 * wanted);
}

void PoseCache::grow(int num_bodies) { poses_.resize(static_cast<std::size_t>(num_bodies)); }

bool is_finite(const model::BodyPose& pose) {
  double sum = 0;  // NaN and infinity survive a sum
  for (const double value : pose.position) sum += value;
  for (const double value : pose.rotation) sum += value;
  return std::isfinite(sum);
}

PairTable::PairTable(std::span<const PackedWorld> worlds, const GeomOrder& order) : order_(&order) {
  for (const PackedWorld& world : worlds) {
    World& one = worlds_.emplace_back();
    one.model = world.model;
    for (const model::Geom& geom : world.model->geoms)
      one.geoms.push_back({geom.shape, geom.body, geom.material});
    one.most_points = world.model->contact_law.max_per_pair;
    kernels_ = kernels_ && world.lanes_collide;
  }
}

void PairTable::clear() {
  world_begin_.assign(worlds_.size() + 1, 0);
  pairs_.clear();
  for (PairColumn& column : columns_) column.count = 0;
}

void PairTable::start_world(int world) {
  world_ = world;
  world_begin_[static_cast<std::size_t>(world)] = static_cast<int>(pairs_.size());
}

void PairTable::add(int first, int second) {
  pairs_.push_back({std::min(first, second), std::max(first, second)});
}

void PairTable::add(int geom, const int* others, std::uint32_t bits) {
  for (; bits != 0; bits &= bits - 1) add(geom, others[std::countr_zero(bits)]);
}

std::span<geometry::Box> PairTable::boxes(std::size_t count) {
  boxes_.resize(std::max(boxes_.size(), count));
  return std::span(boxes_).first(count);
}

void PairTable::add_all(BroadPhase& broad_phase, std::span<const geometry::Box> boxes,
                        const AwakeGeoms* awake) {
  broad_phase.append_pairs(boxes, awake, pairs_);
}

void PairTable::finish_world() {
  const auto begin = pairs_.begin() + world_begin_[static_cast<std::size_t>(world_)];
  sort(begin, pairs_.end());
  for (PairColumn& column : columns_) column.make_room(pairs_.end() - begin);
  const GeomFacts* geoms = worlds_[static_cast<std::size_t>(world_)].geoms.data();
  for (auto pair = begin; pair != pairs_.end(); ++pair) {
    const Pairing& pairing = pairing_of(geoms[pair->first].shape, geoms[pair->second].shape);
    int a = order_->column(world_, pair->first), b = order_->column(world_, pair->second);
    if (pairing.swapped) std::swap(a, b);
    PairColumn& column = columns_[static_cast<std::size_t>(kernels_ ? pairing.kind : PairKind::other)];
    const auto at = static_cast<std::size_t>(column.count++);
    column.a[at] = a;
    column.b[at] = b;
    column.touch[at] = static_cast<std::int32_t>(pair - pairs_.begin());
  }
  world_begin_[static_cast<std::size_t>(world_) + 1] = static_cast<int>(pairs_.size());
}

void PairTable::pad(int num_lanes) {
  touches_.assign(pairs_.size(), {});
  if (points_.size() < pairs_.size() * Touch::most_points) points_.resize(pairs_.size() * Touch::most_points);
  for (PairColumn& column : columns_) {
    if (column.count == 0) continue;
    column.make_room(num_lanes);
    for (int i = column.count; i % num_lanes != 0; ++i) {
      for (std::vector<std::int32_t>* indices : {&column.a, &column.b, &column.touch})
        (*indices)[static_cast<std::size_t>(i)] = (*indices)[static_cast<std::size_t>(column.count - 1)];
    }
  }
  const PairColumn& others = column(PairKind::other);
  for (int i = 0; i < others.count; ++i)
    touches_[static_cast<std::size_t>(others.touch[static_cast<std::size_t>(i)])].to_fallback = true;
}

void PairTable::append(int world, const model::GeomPair& pair, const Touch& touch,
                       std::vector<model::Contact>& contacts) const {
  const World& one = worlds_[static_cast<std::size_t>(world)];
  const GeomFacts& first = one.geoms[static_cast<std::size_t>(pair.first)];
  const GeomFacts& second = one.geoms[static_cast<std::size_t>(pair.second)];
  const bool first_is_a = first.body != model::no_body;  // a must be a real body
  const model::Material material = model::pair_material(*one.model, pair, first.material, second.material);
  model::Contact contact;
  contact.body_a = first_is_a ? first.body : second.body;
  contact.body_b = first_is_a ? second.body : first.body;
  contact.mu = material.mu;
  contact.restitution = material.restitution;
  contact.geoms = pair;
  const double sign = pairing_of(first.shape, second.shape).swapped == first_is_a ? -1 : 1;
  for (int i = 0; i < std::min<int>(touch.num_points, one.most_points); ++i) {
    const TouchPoint& point = points_[static_cast<std::size_t>(touch.first_point + i)];
    contact.position = model::Vec3(point.position);
    contact.normal = sign * model::Vec3(point.normal);
    contact.depth = point.depth;
    contacts.push_back(contact);
  }
}

}  // namespace pbmpi::solver
