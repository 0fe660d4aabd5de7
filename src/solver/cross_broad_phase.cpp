#include "solver/cross_broad_phase.h"

#include <algorithm>

namespace pbmpi::solver {

using model::Box;

CrossBroadPhase::CrossBroadPhase(const model::Model& model, const model::SpaceMap& map)
    : model_(&model), rule_(model), map_(&map) {}

std::vector<std::vector<int>> CrossBroadPhase::neighbours(std::span<const int> owner,
                                                          std::span<const Box> boxes) {
  std::vector<std::vector<int>> found(boxes.size());
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    for (std::size_t b = a + 1; b < boxes.size(); ++b) {
      if (owner[a] == owner[b] || !boxes[a].overlaps(boxes[b])) continue;
      found[a].push_back(static_cast<int>(b));
      found[b].push_back(static_cast<int>(a));
    }
  }
  return found;
}

void CrossBroadPhase::find_candidates(std::span<const int> owner, std::span<const Box> boxes,
                                      std::span<const model::BodyPose> poses) {
  candidates_.clear();
  const auto neighbours_of = neighbours(owner, boxes);
  for (std::size_t space = 0; space < boxes.size(); ++space) {
    if (neighbours_of[space].empty()) continue;
    for (const int index : map_->geoms_of_space[space]) {
      const model::Geom& geom = model_->geoms[static_cast<std::size_t>(index)];
      const Box box = model::geom_box(geom, poses[static_cast<std::size_t>(geom.body)]);
      const bool near = std::any_of(neighbours_of[space].begin(), neighbours_of[space].end(), [&](int other) {
        return box.overlaps(boxes[static_cast<std::size_t>(other)]);
      });
      if (near) candidates_.push_back({box, index, owner[space]});
    }
  }
}

void CrossBroadPhase::find_pairs(std::span<const int> owner, std::span<const Box> boxes,
                                 std::span<const model::BodyPose> poses,
                                 std::vector<model::GeomPair>& pairs) {
  pairs.clear();
  find_candidates(owner, boxes, poses);
  std::sort(candidates_.begin(), candidates_.end(),
            [](const Candidate& a, const Candidate& b) { return a.box.min[0] < b.box.min[0]; });
  for (std::size_t i = 0; i < candidates_.size(); ++i) {
    const Candidate& a = candidates_[i];
    for (std::size_t j = i + 1; j < candidates_.size(); ++j) {
      const Candidate& b = candidates_[j];
      if (b.box.min[0] > a.box.max[0]) break;
      if (a.owner == b.owner || !a.box.overlaps(b.box) || !rule_.may_touch(a.geom, b.geom)) continue;
      pairs.push_back({std::min(a.geom, b.geom), std::max(a.geom, b.geom)});
    }
  }
  std::sort(pairs.begin(), pairs.end());
}

}  // namespace pbmpi::solver
