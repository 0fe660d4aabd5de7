/// A JSON document as text, whatever bytes its texts have.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace pbmpi::app {

/// Names of files and scenes may be no UTF-8, which JSON must be: U+FFFD stands for what is none. `indent`:
/// -1 = all on one line.
template <class Json>
std::string json_text(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace pbmpi::app
