/// The errors that "pbreport diff" reports of a run's positions, velocities, ... joined over frames.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>

#include "analysis/error_table.h"

namespace pbmpi::app {

/// The bands and sizes of the tables from `first` to before `last` (at most all), joined; no p99, which
/// cannot be computed from theirs. The rms is over entries that have a finite error, as in each table.
analysis::ErrorTable joined_errors(const nlohmann::json& tables, std::size_t first, std::size_t last);

}  // namespace pbmpi::app
