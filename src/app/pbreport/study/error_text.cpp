#include "app/pbreport/study/error_text.h"

#include <nlohmann/json.hpp>

namespace pbmpi::app {

std::string bands_text(const analysis::BandCounts& bands, const char* separator) {
  std::string text;
  for (const std::int64_t count : bands) text += (text.empty() ? "" : separator) + std::to_string(count);
  return text;
}

nlohmann::ordered_json errors_json(const analysis::ErrorTable& table) {
  nlohmann::ordered_json json;
  for (const analysis::NamedSummary& named : analysis::error_columns) {
    const analysis::ErrorSummary& error = table.*named.summary;
    json[std::string(named.name) + "_" + named.unit] = {
        {"rms", error.rms}, {"p99", error.p99}, {"max", error.max}, {"bands", error.bands}};
  }
  return json;
}

}  // namespace pbmpi::app
