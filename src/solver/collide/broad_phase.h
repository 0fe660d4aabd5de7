/// Finds the pairs of geoms of one world that may touch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box.h"
#include "model/contact.h"
#include "model/model.h"
#include "model/touch_rule.h"
#include "solver/layout/awake_geoms.h"

namespace pbmpi::solver {

/// Tests the bounding boxes of some geoms against each other, and planes against bounding boxes.
class BroadPhase {
 public:
  /// `model` is borrowed; `geoms` ascending; boxes are enlarged by `margin_m`; `broken_in`: State::broken_in.
  BroadPhase(const model::Model& model, std::span<const int> geoms, double margin_m = 0,
             std::span<const std::int32_t> broken_in = {});

  /// The pairs (first < second, by geom index) whose boxes overlap, sorted; if `awake` is given, only those
  /// with an awake geom. `poses`: [num_bodies].
  void find_pairs(std::span<const model::BodyPose> poses, const AwakeGeoms* awake,
                  std::vector<model::GeomPair>& pairs);

 private:
  void update_boxes(std::span<const model::BodyPose> poses);
  void find_awake(const AwakeGeoms* awake);
  bool is_awake(int geom) const { return awake_[static_cast<std::size_t>(geom)] != 0; }
  void test_planes(std::vector<model::GeomPair>& pairs) const;
  void test_listed(std::vector<model::GeomPair>& pairs) const;
  void sort_along_x();
  void sweep(std::vector<model::GeomPair>& pairs) const;
  void sweep_from(int geom, std::span<const int> others, std::vector<model::GeomPair>& pairs) const;

  const model::Model* model_;
  double margin_m_;
  model::TouchRule rule_;
  std::vector<geometry::Box> boxes_;  ///< [geoms]; planes have none
  std::vector<int> solids_;           ///< geoms that are not planes
  std::vector<int> planes_;
  std::vector<model::GeomPair> listed_;  ///< pairs that may touch, in a world of few geoms
  bool listed_only_ = false;
  std::vector<char> awake_;       ///< [geoms] is the geom awake? All are, unless some may sleep
  std::vector<int> order_;        ///< the solids along the sweep's axis
  std::vector<int> awake_order_;  ///< the awake ones of order_
};

}  // namespace pbmpi::solver
