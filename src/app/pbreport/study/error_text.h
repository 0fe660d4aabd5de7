/// Errors of a case as text and JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "analysis/error_table.h"

namespace pbmpi::app {

/// "185/0/0/0/0": bodies per band.
std::string bands_text(const analysis::BandCounts& bands, const char* separator = "/");

/// rms, p99, max and bands of each column of the table, e.g. under "body_position_m".
nlohmann::ordered_json errors_json(const analysis::ErrorTable& table);

}  // namespace pbmpi::app
