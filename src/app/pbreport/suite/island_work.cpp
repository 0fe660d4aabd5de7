#include "app/pbreport/suite/island_work.h"

#include <cstdlib>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::app {
namespace {

int whole_parameter(const io::RunData& run, const std::string& name) {
  return std::atoi(core::value_in(run.parameters, name).c_str());
}

}  // namespace

double IslandWork::cubed_rows() const {
  double sum = 0;
  for (const std::vector<SolvedIsland>& step : islands) {
    for (const SolvedIsland& island : step) {
      const double rows = island.rows;
      sum += rows * rows * rows;
    }
  }
  return islands.empty() ? 0 : steps_per_frame * sum / static_cast<double>(islands.size());
}

IslandWork island_work(const io::RunData& run, const std::string& path) {
  core::require_input(!run.islands.empty(),
                      path + ": it has no times of islands; record the run with --record-islands");
  IslandWork work;
  work.scene = core::value_in(run.parameters, "scene");
  work.stepper = core::value_in(run.parameters, "stepper");
  work.iterations = whole_parameter(run, "iterations");
  work.steps_per_frame = whole_parameter(run, "steps_per_frame");
  work.bodies = static_cast<int>(run.bodies.id.size());
  for (std::size_t frame = 0; frame < run.frame_measured.size(); ++frame) {
    if (!run.frame_measured[frame]) continue;
    work.frame_s += run.frame_wall_s[frame];
    std::vector<SolvedIsland>& step = work.islands.emplace_back();
    for (const io::IslandRow& island : run.islands[frame]) step.push_back({island.rows, island.solve_s});
  }
  if (!work.islands.empty()) work.frame_s /= static_cast<double>(work.islands.size());
  return work;
}

}  // namespace pbmpi::app
