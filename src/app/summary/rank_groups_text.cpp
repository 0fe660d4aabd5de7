#include "app/summary/rank_groups_text.h"

#include <algorithm>
#include <sstream>

#include <fmt/core.h>

namespace pbmpi::app {

std::string to_text(const mpi::RankGroups& groups) {
  std::string text;
  for (std::size_t group = 0; group < groups.ranks.size(); ++group)
    text += fmt::format("{}{}:{}", group == 0 ? "" : ",", groups.ranks[group], groups.worlds[group]);
  return text;
}

mpi::RankGroups rank_groups_from_text(const std::string& text) {
  mpi::RankGroups groups;
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

std::string in_words(const mpi::RankGroups& groups) {
  const auto [fewest, most] = std::ranges::minmax(groups.ranks);
  const std::string sizes = fewest == most ? std::to_string(most) : fmt::format("{} to {}", fewest, most);
  return fmt::format("{} {} of {} {}", groups.num_groups(), groups.num_groups() == 1 ? "group" : "groups",
                     sizes, most == 1 ? "rank" : "ranks");
}

}  // namespace pbmpi::app
