#include "solver/layout/cells.h"

#include <algorithm>
#include <cstddef>

namespace pbmpi::solver {
namespace {

class Cutter {
 public:
  Cutter(const model::Model& model, std::span<const Articulation> articulations, int most_bodies)
      : most_bodies_(most_bodies), cells_(articulations.size()) {
    items_.reserve(articulations.size());
    for (const Articulation& articulation : articulations) {
      const auto first = static_cast<std::size_t>(articulation.bodies.front());
      items_.push_back({model.bodies[first].pose.position, static_cast<int>(articulation.bodies.size()),
                        static_cast<int>(items_.size())});
    }
  }

  std::vector<int> cut() {
    cut(items_);
    return std::move(cells_);
  }

 private:
  struct Item {
    model::Vec3 position;
    int num_bodies = 0, articulation = 0;
  };
  using Items = std::span<Item>;

  void cut(Items items) {
    int bodies = 0;
    for (const Item& item : items) bodies += item.num_bodies;
    if (bodies <= most_bodies_ || items.size() == 1) {
      for (const Item& item : items) cells_[static_cast<std::size_t>(item.articulation)] = num_cells_;
      ++num_cells_;
      return;
    }
    const std::size_t place = sort_and_find_gap(items);
    cut(items.first(place));
    cut(items.subspan(place));
  }

  /// The first item after the gap.
  static std::size_t sort_and_find_gap(Items items) {
    model::Vec3 low = items.front().position, high = low;
    for (const Item& item : items) {
      low = low.cwiseMin(item.position);
      high = high.cwiseMax(item.position);
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    std::ranges::sort(items, [axis](const Item& a, const Item& b) {
      return std::pair(a.position[axis], a.articulation) < std::pair(b.position[axis], b.articulation);
    });
    const auto gap = [&](std::size_t i) { return items[i].position[axis] - items[i - 1].position[axis]; };
    const std::size_t middle = items.size() / 2, reach = items.size() / 4;
    double widest = 0;
    for (std::size_t i = middle - reach; i <= middle + reach; ++i) {
      if (i > 0 && i < items.size()) widest = std::max(widest, gap(i));
    }
    // The nearest to the middle of those at least half as wide.
    for (std::size_t off = 0; off < reach; ++off) {
      for (const std::size_t i : {middle - off, middle + off}) {
        if (gap(i) >= widest / 2) return i;
      }
    }
    return middle;
  }

  int most_bodies_, num_cells_ = 0;
  std::vector<Item> items_;
  std::vector<int> cells_;
};

}  // namespace

std::vector<int> find_cells(const model::Model& model, std::span<const Articulation> articulations,
                            int most_bodies) {
  if (model.num_bodies() <= most_bodies) return std::vector<int>(articulations.size(), 0);
  return Cutter(model, articulations, most_bodies).cut();
}

}  // namespace pbmpi::solver
