#include "solver/collide/awake_geoms.h"

namespace pbmpi::solver {

void AwakeGeoms::find(const ActiveBodies& awake, int world) {
  words_.assign(swept_.size() / 32 + 1, 0);
  chunks_.clear();
  for (std::size_t i = 0; i < swept_.size(); ++i) {
    const int body = model_->geoms[static_cast<std::size_t>(swept_[i])].body;
    if (body == model::no_body || !awake.contains(world, body)) continue;
    words_[i / 32] |= std::uint32_t{1} << (i % 32);
    const int first = static_cast<int>(i) / num_lanes_ * num_lanes_;
    if (chunks_.empty() || chunks_.back() != first) chunks_.push_back(first);
  }
}

void AwakeGeoms::add_chunks(int first_column, std::vector<int>& chunks) const {
  for (std::size_t i = 0; i < swept_.size(); ++i) {
    const int chunk = (first_column + static_cast<int>(i)) / num_lanes_;
    if (contains(static_cast<int>(i)) && (chunks.empty() || chunks.back() != chunk)) chunks.push_back(chunk);
  }
}

}  // namespace pbmpi::solver
