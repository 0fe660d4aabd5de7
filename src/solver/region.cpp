#include "solver/region.h"

namespace pbmpi::solver {

Region::Region(const model::Model& whole, const model::SpaceMap& map, const std::vector<char>& is_own)
    : model_(whole) {
  model_.events.clear();
  model_.geoms.clear();
  for (std::size_t i = 0; i < whole.geoms.size(); ++i) {
    const int body = whole.geoms[i].body;
    if (body != model::no_body && !is_own[map.space_of_body(body)]) continue;
    geoms_.push_back(static_cast<int>(i));
    model_.geoms.push_back(whole.geoms[i]);
  }
  broad_phase_.emplace(model_);
}

void Region::find_pairs(std::span<const model::BodyPose> poses, std::vector<model::GeomPair>& pairs) {
  broad_phase_->find_pairs(poses, pairs);
  for (model::GeomPair& pair : pairs) pair = {geoms_[pair.first], geoms_[pair.second]};
}

}  // namespace pbmpi::solver
