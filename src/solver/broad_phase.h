/// Finds the pairs of geoms of one world that may touch.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "model/contact.h"
#include "model/model.h"

namespace pbmpi::solver {

/// Bounding boxes against each other, planes against bounding boxes. Which pairs may touch at all: not two
/// static geoms, not two of one body, not two of one actor without self_collision, not two of bodies that
/// share a joint.
class BroadPhase {
 public:
  /// `model` is borrowed.
  explicit BroadPhase(const model::Model& model);

  /// The pairs (first < second, by geom index) whose boxes overlap, sorted. `poses`: [num_bodies].
  void find_pairs(std::span<const model::BodyPose> poses, std::vector<model::GeomPair>& pairs);

 private:
  struct Box {
    std::array<double, 3> min, max;
  };
  bool may_touch(int first, int second) const;
  Box box_of(const model::Geom& geom, const model::BodyPose& body) const;
  void update_boxes(std::span<const model::BodyPose> poses);
  void test_planes(std::vector<model::GeomPair>& pairs) const;
  void test_listed(std::vector<model::GeomPair>& pairs) const;
  void sweep(std::vector<model::GeomPair>& pairs);

  const model::Model* model_;
  std::vector<Box> boxes_;   ///< [geoms]; planes have none
  std::vector<int> solids_;  ///< geoms that are not planes
  std::vector<int> planes_;
  std::vector<model::GeomPair> listed_;  ///< pairs that may touch, in a world of few geoms
  bool listed_only_ = false;
  std::vector<int> order_;                ///< of the solids along the sweep's axis
  std::vector<std::vector<int>> joined_;  ///< [num_bodies] bodies with a joint to it, sorted
};

}  // namespace pbmpi::solver
