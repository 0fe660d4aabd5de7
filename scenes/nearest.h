/// Names near to a mistyped one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pbmpi::scenes {

/// 'text', in single quotes.
std::string in_quotes(std::string_view text);

/// Those of `names` that a typing slip may have meant, nearest first, at most three; upper and lower case are
/// equal. Empty if none is near.
std::vector<std::string> nearest_names(std::string_view name, const std::vector<std::string>& names);

/// "; did you mean 'a' or 'b'?", or if nothing is near "; known: 'a', 'b', 'c'".
std::string suggestion(std::string_view name, const std::vector<std::string>& names);

}  // namespace pbmpi::scenes
