/// The rows of "pbreport islands" and "pbreport cores" as JSON, for --json and the page.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/pbreport/suite/characterise.h"

namespace pbmpi::app {

/// Paper and relative difference are null where the paper lacks the scene or the number.
nlohmann::ordered_json to_json(const IslandSummary& summary);
nlohmann::ordered_json to_json(const CoreSummary& summary);

}  // namespace pbmpi::app
