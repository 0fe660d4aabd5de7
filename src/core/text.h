/// Small helpers for messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pbmpi::core {

/// Number of single-character insertions, deletions and replacements that turn a into b (Levenshtein
/// distance).
int edit_distance(std::string_view a, std::string_view b);

/// The name nearest to `word` (ignoring case) if it is near enough to be a slip: at most a third of the
/// longer one's characters differ, or one begins with the other. Empty if none is.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

}  // namespace pbmpi::core
