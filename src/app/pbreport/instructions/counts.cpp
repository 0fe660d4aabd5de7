#include "app/pbreport/instructions/counts.h"

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/system/input_file.h"

namespace pbmpi::app {
namespace {

using Json = nlohmann::ordered_json;  // keeps the scenes in the order of the file

Json document_of(const std::string& path) {
  return Json::parse(core::read_input_file(path, "name the figure3.json of jobs/figure3.sh"), nullptr, false);
}

bool is_of_counts(const Json& document) {
  return document.is_object() && document.value("filetype", Json()) == counts_filetype;
}

std::optional<InstructionCounts> counts_of(const Json& scene, const char* stepper) {
  if (!scene.contains(stepper)) return std::nullopt;
  const Json& numbers = scene.at(stepper);
  InstructionCounts counts;
  counts.per_frame = numbers.at("instructions_per_frame").get<double>();
  counts.collision_share = numbers.at("collision_share").get<double>();
  counts.frames = numbers.at("frames").get<int>();
  for (std::size_t i = 0; i < mix_names.size(); ++i)
    counts.mix[i] = numbers.at("mix").at(mix_names[i]).get<double>();
  return counts;
}

}  // namespace

bool has_counts(const std::string& path) { return is_of_counts(document_of(path)); }

std::vector<CountedScene> read_counts(const std::string& path) {
  const Json document = document_of(path);
  core::require_input(is_of_counts(document),
                      path + ": no counts of instructions; name the figure3.json of jobs/figure3.sh");
  std::vector<CountedScene> scenes;
  try {
    for (const auto& [name, scene] : document.at("scenes").items())
      scenes.push_back({name, counts_of(scene, "quick"), counts_of(scene, "direct")});
  } catch (const nlohmann::json::exception& error) {
    throw core::InputError(path + ": it lacks what jobs/figure3.py writes (" + error.what() +
                           "); count again");
  }
  core::require_input(!scenes.empty(), path + ": it has no scene; count again");
  return scenes;
}

}  // namespace pbmpi::app
