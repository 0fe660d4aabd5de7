#include "model/islands.h"

#include <algorithm>
#include <numeric>

#include "model/state.h"

namespace pbmpi::model {

void DisjointSets::reset(int count) {
  parent_.resize(static_cast<std::size_t>(count));
  std::iota(parent_.begin(), parent_.end(), 0);
}

int DisjointSets::find(int member) {
  while (parent_[member] != member) {
    parent_[member] = parent_[parent_[member]];
    member = parent_[member];
  }
  return member;
}

void DisjointSets::unite(int a, int b) {
  a = find(a);
  b = find(b);
  parent_[std::max(a, b)] = std::min(a, b);
}

DisjointSets jointed_bodies(const Model& model, std::span<const std::int32_t> broken_in) {
  DisjointSets jointed(model.num_bodies());
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const bool is_broken = !broken_in.empty() && broken_in[i] != unbroken;
    if (joint.body_b != no_body && !is_broken) jointed.unite(joint.body_a, joint.body_b);
  }
  return jointed;
}

Islands find_islands(int num_bodies, std::span<const std::pair<int, int>> links) {
  DisjointSets sets(num_bodies);
  for (const auto& [a, b] : links) {
    if (a != no_body && b != no_body) sets.unite(a, b);
  }
  Islands islands;
  islands.of_body.resize(static_cast<std::size_t>(num_bodies));
  for (int body = 0; body < num_bodies; ++body) {
    const int lowest = sets.find(body);
    islands.of_body[body] = lowest == body ? islands.count++ : islands.of_body[lowest];
  }
  return islands;
}

}  // namespace pbmpi::model
