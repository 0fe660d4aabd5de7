#include "model/islands.h"

#include <algorithm>
#include <numeric>

#include "model/model.h"

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
