/// Rows of cells as text.
#pragma once

#include <string>
#include <vector>

namespace pbmpi::app {

/// Columns as wide as their longest cell, right-aligned except the last. The first row has their names.
std::string aligned(const std::vector<std::vector<std::string>>& rows);
/// The rows as a table in Markdown.
std::string markdown(const std::vector<std::vector<std::string>>& rows);

}  // namespace pbmpi::app
