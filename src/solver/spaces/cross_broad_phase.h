/// Finds the pairs of geoms that may touch across spaces of different owners.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "geometry/box.h"
#include "model/touch_rule.h"
#include "solver/spaces/space_bodies.h"

namespace pbmpi::solver {

/// Spaces whose boxes stay apart cost the test of their boxes and nothing else; of those that overlap, the
/// geoms in another's box are sorted.
class CrossBroadPhase {
 public:
  /// `model` and `bodies` are borrowed.
  CrossBroadPhase(const model::Model& model, const SpaceBodies& bodies);

  /// Pairs (first < second, by geom index) of bodies whose spaces have different owners and whose boxes
  /// overlap, of those that may touch (TouchRule), sorted. `owner`, `boxes`: [num_spaces]; `poses`:
  /// [num_bodies], of the spaces that overlap another. A pose that is not finite has no pair.
  void find_pairs(std::span<const int> owner, std::span<const geometry::Box> boxes,
                  std::span<const model::BodyPose> poses, std::vector<model::GeomPair>& pairs);

 private:
  /// A geom that reaches into the box of another owner's space.
  struct Entry {
    geometry::Box box;
    int geom = 0;
    int owner = 0;
  };

  /// Finds, for each space, those of other owners whose boxes overlap its own; is there any?
  bool find_neighbours(std::span<const int> owner, std::span<const geometry::Box> boxes);
  void enter(int space, int owner, std::span<const geometry::Box> boxes,
             std::span<const model::BodyPose> poses);
  /// Sorts the entries by owner and, of one owner, by where the axis meets them.
  void sort_along(std::size_t axis);
  /// Pairs each of `a` whose beginning lies in one of `b`, or at it if `ties`, with that one.
  void sweep(std::span<const Entry> a, std::span<const Entry> b, std::size_t axis, bool ties,
             std::vector<model::GeomPair>& pairs) const;

  const model::Model* model_;
  model::TouchRule rule_;
  const SpaceBodies* bodies_;
  std::vector<std::vector<int>> neighbours_;  ///< [num_spaces]
  std::vector<Entry> entries_;
  std::vector<std::vector<std::pair<double, int>>> order_;  ///< [owners] where the axis meets it, index
  std::vector<std::vector<Entry>> lists_;                   ///< [owners] in this order
};

}  // namespace pbmpi::solver
