/// Engines side by side as tables, text, JSON and Markdown.
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/engines/engines_data.h"

namespace pbmpi::app {

/// A table of the report in words; the first row has the names of the columns.
struct EnginesTable {
  std::string title, text;
  std::vector<std::vector<std::string>> rows;
};

/// The solution that the yardstick compares with, e.g. "the common reference".
std::string name_of(Yardstick yardstick);
/// An engine's settings on its front in a scene.
EnginesTable front_table(const SceneOfEngines& scene, Yardstick yardstick);
/// Errors of each engine's own solution in a scene.
EnginesTable own_table(const SceneOfEngines& scene);
EnginesTable verdict_table(const EnginesReport& report);
EnginesTable difference_table(const EnginesReport& report);
EnginesTable version_table(const EnginesReport& report);

std::string engines_to_text(const EnginesReport& report);
std::string engines_to_markdown(const EnginesReport& report);
std::string engines_to_json(const EnginesReport& report);

}  // namespace pbmpi::app
