/// Finds the pairs of geoms that may touch, in an order that depends only on the pairs.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "bullet/objects/shapes.h"
#include "model/contact.h"
#include "model/touch_rule.h"

namespace pbmpi::bullet {

/// The bounding boxes of the shapes, as in Bullet's own broad phase, sorted and swept along one axis.
/// Bullet's broad phases return their pairs in an order that depends on history, which no state holds.
class Pairs {
 public:
  /// `model` and `shapes` are borrowed.
  Pairs(const model::Model& model, const Shapes& shapes);

  /// The pairs whose boxes overlap and which may touch, sorted. Valid until the next call.
  const std::vector<model::GeomPair>& find();
  /// Takes in the joints that are broken from now on: State::broken_in.
  void set_broken(std::span<const std::int32_t> broken_in) { rule_ = model::TouchRule(*model_, broken_in); }

 private:
  struct Box {
    btVector3 low, high;
    int geom = 0;
  };
  void measure();
  int longest_axis() const;
  void offer(int a, int b);

  const model::Model* model_;
  const Shapes* shapes_;
  model::TouchRule rule_;
  std::vector<int> planes_;  ///< plane geoms, which have no box
  std::vector<Box> boxes_;   ///< of the other geoms
  std::vector<model::GeomPair> pairs_;
};

}  // namespace pbmpi::bullet
