#include "app/pbmpi/gather_plan.h"

#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "app/common/json_text.h"

namespace pbmpi::effects {
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(PassTally, worlds, idle_worlds, counts)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(RunPlan, num_worlds, tallies)
}  // namespace pbmpi::effects

namespace pbmpi::app {

effects::RunPlan gather_plan(const mpi::Communicator& comm, std::span<const stepping::LocalWorld> own) {
  effects::RunPlan mine;
  for (const stepping::LocalWorld& world : own) mine.add(*world.model);
  const std::string line = json_text(nlohmann::json(mine)) + "\n";
  const std::vector<char> lines = comm.allgatherv(std::span<const char>(line));
  std::istringstream stream(std::string(lines.begin(), lines.end()));
  effects::RunPlan plan;
  for (std::string one; std::getline(stream, one);)
    plan.add(nlohmann::json::parse(one).get<effects::RunPlan>());
  return plan;
}

}  // namespace pbmpi::app
