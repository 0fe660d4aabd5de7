/// Finds the pairs of geoms that may touch across spaces of different owners.
#pragma once

#include <span>
#include <vector>

#include "model/box.h"
#include "model/space_map.h"
#include "model/touch_rule.h"

namespace pbmpi::solver {

/// Spaces whose boxes stay apart cost the test of their boxes and nothing else.
class CrossBroadPhase {
 public:
  /// Both are borrowed.
  CrossBroadPhase(const model::Model& model, const model::SpaceMap& map);

  /// Pairs (first < second, by geom index) of bodies whose spaces have different owners and whose boxes
  /// overlap, of those that may touch (TouchRule), sorted. `owner`, `boxes`: [num_spaces]; `poses`:
  /// [num_bodies], of the spaces that overlap another.
  void find_pairs(std::span<const int> owner, std::span<const model::Box> boxes,
                  std::span<const model::BodyPose> poses, std::vector<model::GeomPair>& pairs);

  /// For each space, the spaces of other owners that its box overlaps. [num_spaces]
  static std::vector<std::vector<int>> neighbours(std::span<const int> owner,
                                                  std::span<const model::Box> boxes);

 private:
  struct Candidate {
    model::Box box;
    int geom = 0;
    int owner = 0;
  };
  void find_candidates(std::span<const int> owner, std::span<const model::Box> boxes,
                       std::span<const model::BodyPose> poses);

  const model::Model* model_;
  model::TouchRule rule_;
  const model::SpaceMap* map_;
  std::vector<Candidate> candidates_;  ///< geoms in the box of a space of another owner
};

}  // namespace pbmpi::solver
