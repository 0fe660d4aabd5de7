/// JSON text that can stand inside an HTML page.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace pbmpi::io::html {

/// Compact JSON in which '<' is written as its Unicode escape, so that no text of the user can end the script
/// element. Invalid UTF-8 is replaced; a NaN becomes null.
std::string dump(const nlohmann::json& value);

/// Text with the five special characters of HTML escaped.
std::string escape_html(std::string_view text);

}  // namespace pbmpi::io::html
