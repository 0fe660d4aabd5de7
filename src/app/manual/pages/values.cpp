#include "app/manual/pages/values.h"

#include <algorithm>
#include <sstream>

#include "effects/effects.h"
#include "scenes/scene.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

/// The parts of "a|b|c" that are typed literally, not placeholders.
std::vector<std::string> literal_words(const std::string& placeholder) {
  std::vector<std::string> words;
  if (placeholder.find('|') == std::string::npos) return words;
  std::istringstream parts(placeholder);
  for (std::string part; std::getline(parts, part, '|');) {
    if (std::ranges::none_of(part, [](char c) { return (c >= 'A' && c <= 'Z') || c == '.'; }))
      words.push_back(part);
  }
  return words;
}

std::string placeholder_of(const OptionRow& option) {
  if (option.placeholder != "LIST") return option.placeholder;
  for (const stepping::StepOption& step : stepping::step_options()) {
    if (step.name == option.name) return std::string(step.placeholder);
  }
  return option.placeholder;
}

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const auto group : {scenes::SceneGroup::paper, scenes::SceneGroup::effects, scenes::SceneGroup::hard})
    for (const scenes::SceneInfo& scene : scenes::list_scenes(group)) names.push_back(scene.name);
  return names;
}

std::vector<std::string> effect_words(const std::vector<std::string>& signs) {
  std::vector<std::string> words;
  for (const effects::Effect& effect : effects::effect_registry())
    for (const std::string& sign : signs) words.push_back(sign + std::string(effect.name));
  return words;
}

}  // namespace

OfferedValues offered_values(const OptionRow& option) {
  const std::string placeholder = placeholder_of(option);
  const auto says = [&](const char* word) { return placeholder.find(word) != std::string::npos; };
  OfferedValues values{literal_words(placeholder)};
  values.files = says("FILE") || says("OUT");
  values.folders = says("DIR") || says("FOLDER");
  if (option.name.ends_with("scene")) {
    const std::vector<std::string> scenes = scene_names();
    values.words.insert(values.words.end(), scenes.begin(), scenes.end());
  }
  if (option.name == "effects") values.words = effect_words({"+", "-"});
  if (option.name == "effect") values.words = effect_words({""});
  return values;
}

}  // namespace pbmpi::app
