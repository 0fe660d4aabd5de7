#include "app/pbreport/run/run_models.h"

#include <optional>

#include "core/text.h"
#include "scenes/parameter_table.h"

namespace pbmpi::app {

std::vector<std::shared_ptr<const model::Model>> build_worlds(const scenes::Scene& scene,
                                                              const io::RunData& run, std::uint64_t seed) {
  const std::string text = core::value_in(run.parameters, "parameters_text");
  std::optional<scenes::ParameterTable> parameters;
  if (!text.empty()) parameters.emplace(core::value_in(run.parameters, "parameters_file"), text);
  std::vector<std::shared_ptr<const model::Model>> worlds;
  for (const std::int64_t id : run.world_id) {
    const auto number = static_cast<int>(id);
    const bool has_row = parameters && number < parameters->num_worlds();
    worlds.push_back(scene.build(number, seed, has_row ? parameters->of_world(number) : scenes::Overrides()));
  }
  return worlds;
}

}  // namespace pbmpi::app
