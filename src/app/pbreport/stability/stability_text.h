/// A study of stability as text, JSON and Markdown.
#pragma once

#include <string>

#include "app/pbreport/stability/stability_data.h"

namespace pbmpi::app {

std::string stability_to_text(const StabilityMap& map);
std::string stability_to_json(const StabilityMap& map);
/// One row per case, one column per setting; below them how many cases have each verdict under a setting.
std::string stability_to_markdown(const StabilityMap& map);

}  // namespace pbmpi::app
