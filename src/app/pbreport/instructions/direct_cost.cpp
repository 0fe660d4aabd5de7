#include "app/pbreport/instructions/direct_cost.h"

#include <algorithm>
#include <cmath>

namespace pbmpi::app {
namespace {

int most_rows(const IslandWork& work) {
  int most = 0;
  for (const std::vector<SolvedIsland>& step : work.islands) {
    for (const SolvedIsland& island : step) most = std::max(most, island.rows);
  }
  return most;
}

}  // namespace

std::optional<CubicCost> cubic_cost(std::span<const double> ratios) {
  if (ratios.empty()) return std::nullopt;
  const auto [least, most] = std::minmax_element(ratios.begin(), ratios.end());
  double logarithms = 0;
  for (const double ratio : ratios) logarithms += std::log(ratio);
  return CubicCost{*least, std::exp(logarithms / static_cast<double>(ratios.size())), *most,
                   static_cast<int>(ratios.size())};
}

std::optional<CubicCost> counted_cost(const std::vector<CountedScene>& scenes,
                                      const std::vector<IslandWork>& works) {
  std::vector<double> ratios;
  for (const CountedScene& scene : scenes) {
    const IslandWork* work = find_work(works, scene.name);
    if (scene.direct && work != nullptr && most_rows(*work) >= leading_rows)
      ratios.push_back(scene.direct->solver() / work->cubed_rows());
  }
  return cubic_cost(ratios);
}

std::optional<DirectCost> direct_cost(const CountedScene& scene, const std::optional<CubicCost>& cost,
                                      const std::vector<IslandWork>& works) {
  if (scene.direct) {
    const double counted = scene.direct->per_frame;
    return DirectCost{counted, counted, counted, true};
  }
  const IslandWork* work = find_work(works, scene.name);
  if (!cost || work == nullptr || !scene.quick) return std::nullopt;
  const double collision = scene.quick->per_frame - scene.quick->solver(), cubes = work->cubed_rows();
  return DirectCost{collision + cost->least * cubes, collision + cost->middle * cubes,
                    collision + cost->most * cubes};
}

const IslandWork* find_work(const std::vector<IslandWork>& works, const std::string& scene) {
  const auto found = std::ranges::find(works, scene, &IslandWork::scene);
  return found == works.end() ? nullptr : &*found;
}

}  // namespace pbmpi::app
