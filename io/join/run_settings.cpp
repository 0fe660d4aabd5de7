#include "io/join/run_settings.h"

#include <algorithm>
#include <array>
#include <set>

namespace pbmpi::io {

Matters matters_for(std::string_view name) {
  constexpr std::array seeds = {"seed", "solver_seed", "world_range"};
  constexpr std::array nothing = {"ranks",        "threads",        "processors",      "build",
                                  "simd",         "decompose",      "budget",          "frames",
                                  "record_every", "record_islands", "record_contacts", "record_residuals",
                                  "resumed_from", "joined_from",    "parameters_file", "ranks_per_world",
                                  "rank_groups",  "on_blowup"};
  if (std::ranges::find(seeds, name) != seeds.end()) return Matters::seed;
  if (name == "feec" || name.starts_with("estimate_")) return Matters::estimate;
  const bool is_free = std::ranges::find(nothing, name) != nothing.end() || name.starts_with("library_") ||
                       name.starts_with("env_");
  return is_free ? Matters::nothing : Matters::results;
}

std::vector<ParameterDifference> differences(const Parameters& a, const Parameters& b, Matters matters) {
  std::set<std::string> names;
  for (const Parameters* all : {&a, &b}) {
    for (const auto& [name, value] : *all) {
      if (matters_for(name) == matters) names.insert(name);
    }
  }
  const auto value_in = [](const Parameters& all, const std::string& name) {
    const auto found = all.find(name);
    return found == all.end() ? "(none)" : found->second;
  };
  std::vector<ParameterDifference> found;
  for (const std::string& name : names) {
    ParameterDifference one{name, value_in(a, name), value_in(b, name)};
    if (one.a != one.b) found.push_back(std::move(one));
  }
  return found;
}

std::string text_of(const ParameterDifference& difference, const std::string& path_a,
                    const std::string& path_b) {
  constexpr std::size_t most_letters = 60;
  const auto is_short = [](const std::string& text) {
    return text.size() <= most_letters && text.find('\n') == std::string::npos;
  };
  if (!is_short(difference.a) || !is_short(difference.b))
    return difference.name + " is not the same in " + path_a + " and " + path_b;
  return difference.name + " is " + difference.a + " in " + path_a + " and " + difference.b + " in " + path_b;
}

}  // namespace pbmpi::io
