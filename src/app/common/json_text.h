/// JSON documents as text, whatever bytes their texts have and whatever their numbers are.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace pbmpi::app {

/// Names of files and scenes may be no UTF-8, which JSON must be: U+FFFD stands for what is none. `indent`:
/// -1 = all on one line.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// JSON has no word for what is not finite.
inline nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

}  // namespace pbmpi::app
