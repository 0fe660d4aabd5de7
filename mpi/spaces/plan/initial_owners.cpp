#include "mpi/spaces/plan/initial_owners.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "mpi/balance/partition.h"
#include "mpi/spaces/plan/rank_groups.h"

namespace pbmpi::mpi {
namespace {

using Spaces = std::span<int>;

class Bisection {
 public:
  Bisection(std::span<const double> cost, std::span<const core::Vec3> centre, int num_ranks)
      : cost_(cost), centre_(centre), owner_(cost.size(), 0) {
    constexpr double most_imbalance = 1.1;
    most_load_ = most_imbalance * std::accumulate(cost.begin(), cost.end(), 0.0) / num_ranks;
  }

  /// Shares `spaces` among `num_ranks` ranks from `first_rank` on.
  void share(Spaces spaces, int first_rank, int num_ranks) {
    const int lower_ranks = num_ranks / 2;
    const std::size_t count =
        num_ranks > 1 && spaces.size() > 1 ? cut(spaces, lower_ranks, num_ranks - lower_ranks) : 0;
    if (count == 0) return share_by_cost(spaces, first_rank, num_ranks);
    share(spaces.first(count), first_rank, lower_ranks);
    share(spaces.subspan(count), first_rank + lower_ranks, num_ranks - lower_ranks);
  }
  std::vector<int> take_owners() { return std::move(owner_); }

 private:
  /// Sorts the spaces along an axis, longest sides first, on which a cut leaves both sides balanced, and
  /// returns how many are below the cut; 0 if there is no such axis.
  std::size_t cut(Spaces spaces, int lower_ranks, int upper_ranks) const {
    for (const int axis : axes_by_length(spaces)) {
      const auto along = [&](int space) { return std::pair(centre_[space][axis], space); };
      std::ranges::sort(spaces, {}, along);
      if (const std::size_t count = best_cut(spaces, lower_ranks, upper_ranks)) return count;
    }
    return 0;
  }

  std::size_t best_cut(Spaces spaces, int lower_ranks, int upper_ranks) const {
    double above = 0, below = 0, least = most_load_;
    for (const int space : spaces) above += cost_[space];
    std::size_t best = 0;
    for (std::size_t i = 0; i + 1 < spaces.size(); ++i) {
      below += cost_[spaces[i]];
      above -= cost_[spaces[i]];
      const double load = std::max(below / lower_ranks, above / upper_ranks);
      if (load > least) continue;
      best = i + 1;
      least = load;
    }
    return best;
  }

  std::array<int, 3> axes_by_length(Spaces spaces) const {
    std::array<double, 3> length{};
    for (int axis = 0; axis < 3; ++axis) {
      const auto [low, high] =
          std::ranges::minmax(spaces, {}, [&](int space) { return centre_[space][axis]; });
      length[axis] = centre_[high][axis] - centre_[low][axis];
    }
    std::array<int, 3> axes = {0, 1, 2};
    std::ranges::stable_sort(axes, std::ranges::greater{}, [&](int axis) { return length[axis]; });
    return axes;
  }

  void share_by_cost(Spaces spaces, int first_rank, int num_ranks) {
    std::ranges::sort(spaces);
    std::vector<double> costs;
    for (const int space : spaces) costs.push_back(cost_[space]);
    const Placement placement = lpt_placement(costs, num_ranks);
    for (std::size_t i = 0; i < spaces.size(); ++i) owner_[spaces[i]] = first_rank + placement[i];
  }

  std::span<const double> cost_;
  std::span<const core::Vec3> centre_;
  double most_load_;  ///< of a rank
  std::vector<int> owner_;
};

}  // namespace

std::vector<int> owners_by_place(std::span<const double> cost, std::span<const core::Vec3> centre,
                                 int num_ranks) {
  Bisection bisection(cost, centre, num_ranks);
  std::vector<int> spaces(cost.size());
  std::iota(spaces.begin(), spaces.end(), 0);
  bisection.share(spaces, 0, num_ranks);
  return bisection.take_owners();
}

std::vector<int> initial_owners(const model::Model& model, const model::SpaceMap& map, int num_ranks) {
  std::vector<core::Vec3> centre(map.num_spaces(), core::Vec3::Zero());
  for (std::size_t space = 0; space < centre.size(); ++space) {
    double num_bodies = 0;
    for (const int unit : map.units_of_space[space]) {
      for (const int body : map.bodies_of_unit[unit]) {
        centre[space] += model.bodies[body].pose.position;
        ++num_bodies;
      }
    }
    if (num_bodies > 0) centre[space] /= num_bodies;
  }
  return owners_by_place(space_costs(map), centre, num_ranks);
}

}  // namespace pbmpi::mpi
