#include "solver/collide/broad_phase.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/geometry.h"

namespace pbmpi::solver {
namespace {

using model::BodyPose;
using model::Geom;
using model::GeomPair;
using model::Shape;

/// Above this number sorting beats testing the list of all pairs (bench_sor --broad-phase).
constexpr std::size_t most_listed_solids = 96;

}  // namespace

BroadPhase::BroadPhase(const model::Model& model, std::span<const int> geoms, double margin_m,
                       std::span<const std::int32_t> broken_in)
    : model_(&model),
      margin_m_(margin_m),
      rule_(model, broken_in),
      boxes_(model.geoms.size()),
      awake_(model.geoms.size(), 1) {
  for (const int index : geoms) {
    const Geom& geom = model.geoms[static_cast<std::size_t>(index)];
    (geom.shape == Shape::plane ? planes_ : solids_).push_back(index);
    if (geom.body == model::no_body && geom.shape != Shape::plane)
      boxes_[static_cast<std::size_t>(index)] =
          geometry::geom_box(geom, geometry::static_pose()).grown(margin_m_);
  }
  order_ = solids_;
  listed_only_ = solids_.size() <= most_listed_solids;
  if (!listed_only_) return;
  for (std::size_t i = 0; i < solids_.size(); ++i) {
    for (std::size_t j = i + 1; j < solids_.size(); ++j) {
      if (rule_.may_touch(solids_[i], solids_[j])) listed_.push_back({solids_[i], solids_[j]});
    }
  }
}

void BroadPhase::update_boxes(std::span<const BodyPose> poses) {
  for (int index : solids_) {
    const Geom& geom = model_->geoms[static_cast<std::size_t>(index)];
    if (geom.body != model::no_body) {
      boxes_[static_cast<std::size_t>(index)] =
          geometry::geom_box(geom, poses[static_cast<std::size_t>(geom.body)]).grown(margin_m_);
    }
  }
}

void BroadPhase::find_awake(const AwakeGeoms* awake) {
  if (awake == nullptr) return;
  for (std::size_t geom = 0; geom < awake_.size(); ++geom)
    awake_[geom] = awake->has_geom(static_cast<int>(geom)) ? 1 : 0;
}

/// A box reaches below a plane if its lowest corner does.
void BroadPhase::test_planes(std::vector<GeomPair>& pairs) const {
  for (int plane : planes_) {
    const Geom& geom = model_->geoms[static_cast<std::size_t>(plane)];
    const model::Vec3 normal = geom.local.direction_to_outer(model::Vec3::UnitZ());
    const double offset = normal.dot(geom.local.position);
    for (int solid : solids_) {
      if (!is_awake(solid) || model_->geoms[static_cast<std::size_t>(solid)].body == model::no_body) continue;
      const geometry::Box& box = boxes_[static_cast<std::size_t>(solid)];
      double nearest = 0;
      for (int k = 0; k < 3; ++k) {
        nearest += normal[k] * (normal[k] > 0 ? box.min[static_cast<std::size_t>(k)]
                                              : box.max[static_cast<std::size_t>(k)]);
      }
      if (nearest <= offset && rule_.may_touch(plane, solid))
        pairs.push_back({std::min(plane, solid), std::max(plane, solid)});
    }
  }
}

void BroadPhase::test_listed(std::vector<GeomPair>& pairs) const {
  for (const GeomPair& pair : listed_) {
    if (!is_awake(pair.first) && !is_awake(pair.second)) continue;
    if (boxes_[static_cast<std::size_t>(pair.first)].overlaps(
            boxes_[static_cast<std::size_t>(pair.second)])) {
      pairs.push_back(pair);
    }
  }
}

/// Insertion sort, since the previous step's order is nearly right.
void BroadPhase::sort_along_x() {
  const auto low = [&](int geom) { return boxes_[static_cast<std::size_t>(geom)].min[0]; };
  for (std::size_t i = 1; i < order_.size(); ++i) {
    const int geom = order_[i];
    std::size_t j = i;
    for (; j > 0 && low(order_[j - 1]) > low(geom); --j) order_[j] = order_[j - 1];
    order_[j] = geom;
  }
  awake_order_.clear();
  std::ranges::copy_if(order_, std::back_inserter(awake_order_), [this](int geom) { return is_awake(geom); });
}

/// Sweep and prune along x. A sleeping geom is tested against awake ones only.
void BroadPhase::sweep(std::vector<GeomPair>& pairs) const {
  const std::span<const int> all = order_, awake = awake_order_;
  std::size_t num_awake = 0;  // so far
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (is_awake(all[i])) {
      ++num_awake;
      sweep_from(all[i], all.subspan(i + 1), pairs);
    } else {
      sweep_from(all[i], awake.subspan(num_awake), pairs);
    }
  }
}

/// `others` begin no farther left than `geom`.
void BroadPhase::sweep_from(int geom, std::span<const int> others, std::vector<GeomPair>& pairs) const {
  const geometry::Box& box = boxes_[static_cast<std::size_t>(geom)];
  for (const int other : others) {
    const geometry::Box& other_box = boxes_[static_cast<std::size_t>(other)];
    if (other_box.min[0] > box.max[0]) return;
    if (!box.overlaps(other_box)) continue;
    const auto [first, second] = std::minmax(geom, other);
    if (rule_.may_touch(first, second)) pairs.push_back({first, second});
  }
}

void BroadPhase::find_pairs(std::span<const BodyPose> poses, const AwakeGeoms* awake,
                            std::vector<GeomPair>& pairs) {
  pairs.clear();
  find_awake(awake);
  update_boxes(poses);
  test_planes(pairs);
  if (listed_only_) {
    test_listed(pairs);
  } else {
    sort_along_x();
    sweep(pairs);
  }
  std::sort(pairs.begin(), pairs.end());
}

}  // namespace pbmpi::solver
