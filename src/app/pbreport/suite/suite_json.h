/// The rows of "pbreport islands" and "pbreport cores" as JSON: what --json prints and the page shows.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "app/pbreport/suite/characterise.h"

namespace pbmpi::app {

/// Paper and relative difference are null where the scene or its number is not the paper's.
nlohmann::ordered_json to_json(const IslandSummary& summary);
nlohmann::ordered_json to_json(const CoreSummary& summary);

}  // namespace pbmpi::app
