/// The HTML page of engines side by side.
#pragma once

#include <string>

#include "app/pbreport/engines/engines_data.h"

namespace pbmpi::app {

/// Throws core::InputError if the page cannot be written.
void write_engines_page(const std::string& path, const EnginesReport& report);

}  // namespace pbmpi::app
