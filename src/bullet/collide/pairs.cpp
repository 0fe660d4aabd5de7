#include "bullet/collide/pairs.h"

#include <algorithm>
#include <tuple>

namespace pbmpi::bullet {

Pairs::Pairs(const model::Model& model, const Shapes& shapes)
    : model_(&model), shapes_(&shapes), rule_(model) {
  for (int geom = 0; geom < shapes.size(); ++geom) {
    const bool is_plane = model.geoms[static_cast<std::size_t>(geom)].shape == model::Shape::plane;
    if (is_plane)
      planes_.push_back(geom);
    else
      boxes_.push_back({{}, {}, geom});
  }
}

const std::vector<model::GeomPair>& Pairs::find() {
  measure();
  pairs_.clear();
  for (const int plane : planes_)
    for (const Box& box : boxes_) offer(plane, box.geom);
  const int axis = longest_axis();
  std::sort(boxes_.begin(), boxes_.end(), [axis](const Box& a, const Box& b) {
    return std::tuple(a.low[axis], a.geom) < std::tuple(b.low[axis], b.geom);
  });
  for (auto a = boxes_.begin(); a != boxes_.end(); ++a) {
    for (auto b = a + 1; b != boxes_.end() && b->low[axis] <= a->high[axis]; ++b) {
      if (TestAabbAgainstAabb2(a->low, a->high, b->low, b->high)) offer(a->geom, b->geom);
    }
  }
  std::sort(pairs_.begin(), pairs_.end());
  return pairs_;
}

/// Boxes are enlarged by the distance at which Bullet finds contacts, as in
/// btCollisionWorld::updateSingleAabb.
void Pairs::measure() {
  const btVector3 reach(gContactBreakingThreshold, gContactBreakingThreshold, gContactBreakingThreshold);
  for (Box& box : boxes_) {
    shapes_->shape(box.geom).getAabb(shapes_->place(box.geom), box.low, box.high);
    box.low -= reach;
    box.high += reach;
    for (int axis = 0; axis < 3; ++axis) {
      if (box.low[axis] <= box.high[axis]) continue;
      box.low[axis] = -model::infinity;  // replaces NaN, which has no place in an order
      box.high[axis] = model::infinity;
    }
  }
}

/// The axis along which the boxes are spread most.
int Pairs::longest_axis() const {
  if (boxes_.empty()) return 0;
  btVector3 low = boxes_.front().low, high = boxes_.front().low;
  for (const Box& box : boxes_) {
    low.setMin(box.low);
    high.setMax(box.low);
  }
  return (high - low).maxAxis();
}

void Pairs::offer(int a, int b) {
  const auto [first, second] = std::minmax(a, b);
  if (rule_.may_touch(first, second)) pairs_.push_back({first, second});
}

}  // namespace pbmpi::bullet
