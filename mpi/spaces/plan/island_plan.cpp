#include "mpi/spaces/plan/island_plan.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "model/islands.h"

namespace pbmpi::mpi {
namespace {

/// Islands of several ranks that links join into one.
struct Joined {
  std::vector<IslandRef> parts;  ///< by (rank, island)
  std::vector<double> weight;    ///< [ranks]
  double total = 0;
  int solver = 0;
};

class Planner {
 public:
  Planner(std::span<const LocalIslands> ranks, std::span<const IslandLink> links)
      : ranks_(ranks), links_(links), first_(ranks.size() + 1, 0), sets_(0) {
    for (std::size_t rank = 0; rank < ranks.size(); ++rank)
      first_[rank + 1] = first_[rank] + static_cast<int>(ranks[rank].weight.size());
    sets_.reset(first_.back());
    for (const IslandLink& link : links) sets_.unite(index(link.a), index(link.b));
  }

  IslandPlan plan() {
    std::vector<double> load(ranks_.size(), 0);
    std::vector<Joined> joined = find_joined(load);
    std::stable_sort(joined.begin(), joined.end(),
                     [](const Joined& a, const Joined& b) { return a.total > b.total; });
    for (Joined& island : joined) {
      island.solver = choose_solver(island, load);
      load[island.solver] += island.total;
    }
    return to_plan(joined);
  }

 private:
  int index(const IslandRef& island) const { return first_[island.rank] + island.island; }

  /// Finds the islands that links join; adds the weights of all others to the `load` of their ranks.
  std::vector<Joined> find_joined(std::vector<double>& load) {
    std::vector<int> joined_of(static_cast<std::size_t>(first_.back()), -1);
    std::vector<Joined> joined;
    for (const IslandLink& link : links_) {
      const int set = sets_.find(index(link.a));
      if (joined_of[set] >= 0) continue;
      joined_of[set] = static_cast<int>(joined.size());
      joined.push_back({{}, std::vector<double>(ranks_.size(), 0), 0, 0});
    }
    for (int rank = 0; rank < static_cast<int>(ranks_.size()); ++rank) {
      for (int island = 0; island < static_cast<int>(ranks_[rank].weight.size()); ++island) {
        const double weight = ranks_[rank].weight[island];
        const int which = joined_of[sets_.find(first_[rank] + island)];
        if (which < 0) {
          load[rank] += weight;
          continue;
        }
        joined[which].parts.push_back({rank, island});
        joined[which].weight[rank] += weight;
        joined[which].total += weight;
      }
    }
    return joined;
  }

  static int choose_solver(const Joined& island, const std::vector<double>& load) {
    const auto most = std::max_element(island.weight.begin(), island.weight.end());
    const int home = static_cast<int>(most - island.weight.begin());
    int soonest = home;
    for (const IslandRef& part : island.parts) {
      if (load[part.rank] < load[soonest]) soonest = part.rank;
    }
    const double makespan = *std::max_element(load.begin(), load.end());
    return load[home] + island.total <= makespan ? home : soonest;
  }

  IslandPlan to_plan(const std::vector<Joined>& joined) {
    IslandPlan plan;
    std::vector<int> solver_of_set(static_cast<std::size_t>(first_.back()), -1);
    for (const Joined& island : joined) {
      for (const IslandRef& part : island.parts) {
        solver_of_set[sets_.find(index(part))] = island.solver;
        if (part.rank != island.solver) plan.transfers.push_back({part, island.solver});
      }
    }
    std::sort(plan.transfers.begin(), plan.transfers.end(), [](const Transfer& a, const Transfer& b) {
      return std::pair(a.island.rank, a.island.island) < std::pair(b.island.rank, b.island.island);
    });
    for (const IslandLink& link : links_)
      plan.solver_of_link.push_back(solver_of_set[sets_.find(index(link.a))]);
    return plan;
  }

  std::span<const LocalIslands> ranks_;
  std::span<const IslandLink> links_;
  std::vector<int> first_;  ///< [ranks + 1] index of each rank's first island
  model::DisjointSets sets_;
};

}  // namespace

IslandPlan plan_islands(std::span<const LocalIslands> ranks, std::span<const IslandLink> links) {
  if (links.empty()) return {};
  return Planner(ranks, links).plan();
}

}  // namespace pbmpi::mpi
