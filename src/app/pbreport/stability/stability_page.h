/// The HTML page of a study of stability.
#pragma once

#include <string>

#include "app/pbreport/stability/stability_data.h"

namespace pbmpi::app {

/// Throws core::InputError if the page cannot be written.
void write_stability_page(const std::string& path, const io::TableFile& file, const StabilityMap& map,
                          const std::string& file_path);

}  // namespace pbmpi::app
