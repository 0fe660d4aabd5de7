/// Numbers with a unit, as options take them: "3.33ms", "1cm".
#pragma once

#include <string>

namespace pbmpi::app {

/// "3.33ms" -> 0.00333: a number above 0 and one of us, ms, s. Throws core::InputError naming `option`.
double parse_time_s(const std::string& text, const std::string& option);
/// Reads a time as parse_time_s() does, or a bare number in seconds.
double parse_time_or_seconds(const std::string& text, const std::string& option);
/// "1cm" -> 0.01: a number above 0 and one of mm, cm, m. Throws core::InputError naming `option`.
double parse_length_m(const std::string& text, const std::string& option);

}  // namespace pbmpi::app
