/// JSON documents as text, valid whatever bytes their texts and whatever numbers they have.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace pbmpi::app {

/// JSON must be UTF-8, and names of files and scenes may not be: U+FFFD replaces invalid bytes. `indent`: -1
/// = all on one line.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace pbmpi::app
