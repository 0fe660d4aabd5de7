#include "app/pbmpi/gather_plan.h"

#include <sstream>
#include <string>

#include <nlohmann/json.hpp>

#include "app/common/json_text.h"

namespace pbmpi::app {
namespace {

using Json = nlohmann::json;

/// One line of text for the message to the other ranks.
std::string to_line(const effects::RunPlan& plan) {
  Json tallies = Json::array();
  for (const effects::PassTally& tally : plan.tallies)
    tallies.push_back({tally.worlds, tally.idle_worlds, tally.counts});
  return json_text(Json{plan.num_worlds, tallies}) + "\n";
}

effects::RunPlan from_line(const std::string& line) {
  const Json json = Json::parse(line);
  effects::RunPlan plan;
  json.at(0).get_to(plan.num_worlds);
  for (std::size_t i = 0; i < plan.tallies.size(); ++i) {
    const Json& tally = json.at(1).at(i);
    tally.at(0).get_to(plan.tallies[i].worlds);
    tally.at(1).get_to(plan.tallies[i].idle_worlds);
    tally.at(2).get_to(plan.tallies[i].counts);
  }
  return plan;
}

}  // namespace

effects::RunPlan gather_plan(const mpi::Communicator& comm, std::span<const stepping::LocalWorld> own) {
  effects::RunPlan mine;
  for (const stepping::LocalWorld& world : own) mine.add(*world.model);
  const std::string line = to_line(mine);
  const std::vector<char> lines = comm.allgatherv(std::span<const char>(line));
  std::istringstream stream(std::string(lines.begin(), lines.end()));
  effects::RunPlan plan;
  for (std::string one; std::getline(stream, one);) plan.add(from_line(one));
  return plan;
}

}  // namespace pbmpi::app
