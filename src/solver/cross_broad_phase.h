/// Finds the pairs of geoms that may touch across spaces of different owners.
#pragma once

#include <span>
#include <vector>

#include "model/box.h"
#include "model/space_map.h"
#include "model/touch_rule.h"

namespace pbmpi::solver {

/// Spaces whose boxes stay apart cost the test of their boxes and nothing else; of two that overlap, the
/// geoms in each other's box are sorted.
class CrossBroadPhase {
 public:
  /// Both are borrowed.
  CrossBroadPhase(const model::Model& model, const model::SpaceMap& map);

  /// Pairs (first < second, by geom index) of bodies whose spaces have different owners and whose boxes
  /// overlap, of those that may touch (TouchRule), sorted. `owner`, `boxes`: [num_spaces]; `poses`:
  /// [num_bodies], of the spaces that overlap another. A pose that is not finite has no pair.
  void find_pairs(std::span<const int> owner, std::span<const model::Box> boxes,
                  std::span<const model::BodyPose> poses, std::vector<model::GeomPair>& pairs);

 private:
  /// A geom of one of two spaces, where the sweep's axis meets it first.
  struct Entry {
    double low = 0;
    int geom = 0;
    bool in_second = false;
  };

  void update_boxes(int space, std::span<const model::BodyPose> poses);
  /// The geoms of a space that reach into a box; their number.
  std::size_t enter(int space, const model::Box& box, int axis, bool in_second);
  void sweep(int axis, std::vector<model::GeomPair>& pairs);

  const model::Model* model_;
  model::TouchRule rule_;
  const model::SpaceMap* map_;
  std::vector<model::Box> geom_boxes_;  ///< [geoms]
  std::vector<char> has_boxes_;         ///< [num_spaces] are those of its geoms of this call?
  std::vector<Entry> entries_;          ///< of the two spaces at hand
};

}  // namespace pbmpi::solver
