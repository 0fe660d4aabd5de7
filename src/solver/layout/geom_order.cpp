#include "solver/layout/geom_order.h"

#include <algorithm>

namespace pbmpi::solver {
namespace {

constexpr int no_geom = -1;
constexpr int columns_a_line = 16;  ///< numbers in a cache line, and the most lanes

void keep_one_of_each(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

GeomOrder::GeomOrder(std::span<const PackedWorld> worlds) {
  for (const PackedWorld& world : worlds) {
    const int num_geoms = static_cast<int>(world.model->geoms.size());
    const int first = (num_columns() + columns_a_line - 1) / columns_a_line * columns_a_line;
    geom_of_column_.resize(static_cast<std::size_t>(first), no_geom);
    std::vector<char> is_swept(world.model->geoms.size(), world.swept_geoms ? 0 : 1);
    if (world.swept_geoms) {
      for (const int geom : *world.swept_geoms) is_swept[static_cast<std::size_t>(geom)] = 1;
    }
    column_of_geom_.resize(static_cast<std::size_t>(first + num_geoms));
    first_.push_back(first);
    num_swept_.push_back(0);
    for (const char swept : {1, 0}) {
      for (int geom = 0; geom < num_geoms; ++geom) {
        if (is_swept[static_cast<std::size_t>(geom)] != swept) continue;
        column_of_geom_[static_cast<std::size_t>(first + geom)] = num_columns();
        geom_of_column_.push_back(geom);
        num_swept_.back() += swept;
      }
    }
  }
}

std::vector<int> GeomOrder::swept_chunks(int num_lanes) const {
  std::vector<int> chunks;
  for (int world = 0; world < static_cast<int>(first_.size()); ++world) {
    for (const int geom : swept(world)) chunks.push_back(column(world, geom) / num_lanes);
  }
  keep_one_of_each(chunks);
  return chunks;
}

void GeomOrder::find_chunks(int world, std::span<const model::GeomPair> pairs, int num_lanes,
                            std::vector<int>& chunks) const {
  chunks.clear();
  for (const model::GeomPair& pair : pairs) {
    chunks.push_back(column(world, pair.first) / num_lanes);
    chunks.push_back(column(world, pair.second) / num_lanes);
  }
  keep_one_of_each(chunks);
}

}  // namespace pbmpi::solver
