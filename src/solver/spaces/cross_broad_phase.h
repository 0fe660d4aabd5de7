/// Finds the pairs of geoms that may touch across spaces of different owners.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "geometry/box.h"
#include "geometry/box_tree.h"
#include "model/touch_rule.h"
#include "solver/spaces/space_bodies.h"

namespace pbmpi::solver {

/// Spaces whose boxes do not overlap cost only a look into the tree of their boxes; for those that overlap,
/// the geoms in another space's box are sorted.
class CrossBroadPhase {
 public:
  /// `model` and `bodies` are borrowed.
  CrossBroadPhase(const model::Model& model, const SpaceBodies& bodies);

  /// Finds the pairs (first < second, by geom index) of geoms that may touch (TouchRule), whose boxes
  /// overlap, and whose bodies' spaces have different owners, sorted. `owner`, `boxes`: [num_spaces];
  /// `poses`: [num_bodies], current in the spaces that overlap another. A body whose pose is not finite is in
  /// no pair.
  void find_pairs(std::span<const int> owner, std::span<const geometry::Box> boxes,
                  std::span<const model::BodyPose> poses, std::vector<model::GeomPair>& pairs);

  /// The spaces whose boxes overlap one of another owner's space, ascending.
  std::vector<int> near_spaces(std::span<const int> owner, std::span<const geometry::Box> boxes);
  std::vector<int> near_spaces() const;  ///< those of the last find_pairs()

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
  /// Sorts the entries by owner and, within an owner, by where they begin along the axis.
  void sort_along(std::size_t axis);
  /// Pairs each entry of `a` that begins within an entry of `b`, or where it begins if `ties`, with that
  /// entry.
  void sweep(std::span<const Entry> a, std::span<const Entry> b, std::size_t axis, bool ties,
             std::vector<model::GeomPair>& pairs) const;

  const model::Model* model_;
  model::TouchRule rule_;
  const SpaceBodies* bodies_;
  geometry::BoxTree space_tree_;              ///< of the spaces' boxes
  std::vector<std::vector<int>> neighbours_;  ///< [num_spaces]
  std::vector<Entry> entries_;
  std::vector<std::vector<std::pair<double, int>>> order_;  ///< [owners] begin along the axis, index
  std::vector<std::vector<Entry>> lists_;                   ///< [owners] entries in the order of order_
};

}  // namespace pbmpi::solver
