/// Small helpers for texts, and numbers as text.
#pragma once

#include <array>
#include <charconv>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace pbmpi::core {

/// Number of single-character insertions, deletions and replacements that turn a into b (Levenshtein
/// distance).
int edit_distance(std::string_view a, std::string_view b);

/// The names that a typing error may have turned into `word`, nearest first, at most three; ignores case. A
/// third of the letters may differ, or two if that is more, or one name begins with the other.
std::vector<std::string> nearest_names(std::string_view word, const std::vector<std::string>& names);

/// The first of nearest_names(); empty if none is near.
std::string nearest_name(std::string_view word, const std::vector<std::string>& names);

/// 'text', in single quotes.
std::string in_quotes(std::string_view text);

/// "; did you mean 'a' or 'b'?", or if no name is near "; known: 'a', 'b', 'c'".
std::string suggestion(std::string_view word, const std::vector<std::string>& names);

/// The value with this name; empty if there is none.
std::string value_in(const std::map<std::string, std::string>& values, const std::string& name);

/// A number with as many digits as are needed to read it back to the same bits.
template <class Number>
std::string number_text(Number value) {
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

}  // namespace pbmpi::core
