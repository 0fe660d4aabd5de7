#include "mpi/spaces/plan/rank_groups.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <queue>
#include <sstream>
#include <tuple>

#include <fmt/core.h>

#include "core/error.h"

namespace pbmpi::mpi {
namespace {

int sum_of_first(const std::vector<int>& counts, int number) {
  return std::accumulate(counts.begin(), counts.begin() + number, 0);
}

/// The cost of one world for each group.
std::vector<double> costs_of_groups(std::span<const double> space_costs, const RankGroups& groups) {
  std::vector<double> costs;
  for (std::size_t group = 0; group < groups.ranks.size(); ++group) {
    const bool is_like_the_last = group > 0 && groups.ranks[group] == groups.ranks[group - 1];
    costs.push_back(is_like_the_last ? costs.back() : cut_cost(space_costs, groups.ranks[group]));
  }
  return costs;
}

/// Gives one world to each group, and each remaining world to the group that would finish it first; on a tie,
/// to the one with fewer worlds.
void deal_worlds(std::span<const double> space_costs, int num_worlds, RankGroups& groups) {
  using Next = std::tuple<double, int, int>;  // (end time with one more world, worlds so far, group)
  std::priority_queue<Next, std::vector<Next>, std::greater<>> next;
  const std::vector<double> costs = costs_of_groups(space_costs, groups);
  groups.worlds.assign(groups.ranks.size(), 1);
  for (int group = 0; group < groups.num_groups(); ++group) next.emplace(2 * costs[group], 1, group);
  for (int world = groups.num_groups(); world < num_worlds; ++world) {
    const int group = std::get<2>(next.top());
    next.pop();
    const int count = ++groups.worlds[group];
    next.emplace((count + 1) * costs[group], count, group);
  }
}

}  // namespace

int RankGroups::num_worlds() const { return sum_of_first(worlds, num_groups()); }
int RankGroups::first_rank(int group) const { return sum_of_first(ranks, group); }
int RankGroups::first_world(int group) const { return sum_of_first(worlds, group); }

int RankGroups::group_of_rank(int rank) const {
  int group = 0;
  while (group < num_groups() && rank >= ranks[group]) rank -= ranks[group++];
  return group;
}

std::vector<int> RankGroups::worlds_of(int group) const {
  std::vector<int> ids(group < num_groups() ? worlds[group] : 0);
  std::iota(ids.begin(), ids.end(), first_world(group));
  return ids;
}

Placement RankGroups::roots() const {
  Placement placement;
  for (int group = 0; group < num_groups(); ++group)
    placement.insert(placement.end(), worlds[group], first_rank(group));
  return placement;
}

std::vector<double> space_costs(const model::SpaceMap& map) {
  std::vector<double> costs;
  for (const std::vector<int>& units : map.units_of_space) {
    double cost = 0;
    for (const int unit : units)
      cost += map.rows_of_unit[unit] + static_cast<double>(map.bodies_of_unit[unit].size());
    costs.push_back(cost);
  }
  return costs;
}

double cut_cost(std::span<const double> space_costs, int num_ranks) {
  const Placement owners = lpt_placement(space_costs, num_ranks);
  const std::vector<double> loads = rank_loads(owners, space_costs, num_ranks);
  return *std::max_element(loads.begin(), loads.end());
}

RankGroups group_ranks(std::span<const double> space_costs, int num_worlds, int num_ranks,
                       int ranks_per_world) {
  core::require_invariant(num_worlds >= 1 && num_ranks >= 1 && ranks_per_world >= 1,
                          "group_ranks: at least one world, rank, and rank a world");
  const int most_ranks = std::min(ranks_per_world, num_ranks);
  const int num_groups = std::min(num_worlds, (num_ranks + most_ranks - 1) / most_ranks);
  const int num_used = std::min(num_ranks, num_groups * most_ranks);
  RankGroups groups;
  for (int group = 0; group < num_groups; ++group)
    groups.ranks.push_back(num_used / num_groups + (group < num_used % num_groups ? 1 : 0));
  deal_worlds(space_costs, num_worlds, groups);
  return groups;
}

double makespan(std::span<const double> space_costs, const RankGroups& groups) {
  const std::vector<double> costs = costs_of_groups(space_costs, groups);
  double longest = 0;
  for (int group = 0; group < groups.num_groups(); ++group)
    longest = std::max(longest, groups.worlds[group] * costs[group]);
  return longest;
}

int choose_ranks_per_world(std::span<const double> space_costs, int num_worlds, int num_ranks) {
  constexpr double least_gain = 1.1;
  const auto predicted = [&](int ranks_per_world) {
    return makespan(space_costs, group_ranks(space_costs, num_worlds, num_ranks, ranks_per_world));
  };
  int chosen = 1;
  double least = predicted(1);
  const int most = std::min(num_ranks, static_cast<int>(space_costs.size()));
  for (int ranks_per_world = 2; ranks_per_world <= most; ++ranks_per_world) {
    const double time = predicted(ranks_per_world);
    if (time * least_gain > least) continue;
    chosen = ranks_per_world;
    least = time;
  }
  return chosen;
}

std::string to_text(const RankGroups& groups) {
  std::string text;
  for (std::size_t group = 0; group < groups.ranks.size(); ++group)
    text += fmt::format("{}{}:{}", group == 0 ? "" : ",", groups.ranks[group], groups.worlds[group]);
  return text;
}

RankGroups rank_groups_from_text(const std::string& text) {
  RankGroups groups;
  std::istringstream list(text);
  for (std::string one; std::getline(list, one, ',');) {
    int ranks = 0, worlds = 0;
    char colon = 0;
    if (!(std::istringstream(one) >> ranks >> colon >> worlds) || colon != ':' || ranks < 1 || worlds < 0)
      return {};
    groups.ranks.push_back(ranks);
    groups.worlds.push_back(worlds);
  }
  return groups;
}

std::string in_words(const RankGroups& groups) {
  const auto [fewest, most] = std::ranges::minmax(groups.ranks);
  const std::string sizes = fewest == most ? std::to_string(most) : fmt::format("{} to {}", fewest, most);
  return fmt::format("{} {} of {} {}", groups.num_groups(), groups.num_groups() == 1 ? "group" : "groups",
                     sizes, most == 1 ? "rank" : "ranks");
}

}  // namespace pbmpi::mpi
