/// Islands: bodies connected by joints and contacts, which are solved together.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "model/model.h"

namespace pbmpi::model {

/// Disjoint sets of bodies 0 .. n-1. The representative of a set is its lowest body, so that the result does
/// not depend on the order of the unions.
class DisjointSets {
 public:
  explicit DisjointSets(int count) { reset(count); }
  void reset(int count);
  int find(int member);
  void unite(int a, int b);

 private:
  std::vector<int> parent_;
};

/// Sets of bodies connected by unbroken joints. `broken_in`: State::broken_in.
DisjointSets jointed_bodies(const Model& model, std::span<const std::int32_t> broken_in);

/// Islands, numbered in order of their lowest body.
struct Islands {
  std::vector<int> of_body;  ///< [num_bodies] index of the island
  int count = 0;
};

/// `links`: pairs of body indices joined by a joint or a contact; a pair with no_body links nothing.
Islands find_islands(int num_bodies, std::span<const std::pair<int, int>> links);

}  // namespace pbmpi::model
