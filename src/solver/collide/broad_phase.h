/// Finds the pairs of geoms of one world that may touch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box.h"
#include "model/contact.h"
#include "model/model.h"
#include "model/touch_rule.h"

namespace pbmpi::solver {

/// Bounding boxes of some geoms against each other, planes against bounding boxes.
class BroadPhase {
 public:
  /// `model` is borrowed; `geoms` ascending; boxes are larger by `margin_m`; `broken_in`: as in model::State.
  BroadPhase(const model::Model& model, std::span<const int> geoms, double margin_m = 0,
             std::span<const std::int32_t> broken_in = {});

  /// The pairs (first < second, by geom index) whose boxes overlap, sorted. `poses`: [num_bodies].
  void find_pairs(std::span<const model::BodyPose> poses, std::vector<model::GeomPair>& pairs);

 private:
  void update_boxes(std::span<const model::BodyPose> poses);
  void test_planes(std::vector<model::GeomPair>& pairs) const;
  void test_listed(std::vector<model::GeomPair>& pairs) const;
  void sweep(std::vector<model::GeomPair>& pairs);

  const model::Model* model_;
  double margin_m_;
  model::TouchRule rule_;
  std::vector<geometry::Box> boxes_;  ///< [geoms]; planes have none
  std::vector<int> solids_;           ///< geoms that are not planes
  std::vector<int> planes_;
  std::vector<model::GeomPair> listed_;  ///< pairs that may touch, in a world of few geoms
  bool listed_only_ = false;
  std::vector<int> order_;  ///< of the solids along the sweep's axis
};

}  // namespace pbmpi::solver
