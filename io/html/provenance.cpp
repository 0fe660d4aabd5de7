#include "io/html/provenance.h"

#include <nlohmann/json.hpp>

#include "core/text.h"
#include "io/html/escape.h"

namespace pbmpi::io::html {
namespace {

using Attributes = std::map<std::string, std::string>;

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) {
    if (!part.empty()) text += (text.empty() ? "" : " · ") + part;
  }
  return text;
}

std::string origin(const Attributes& attributes) {
  const std::string version = core::value_in(attributes, "pbmpi_version");
  return joined({version.empty() ? "" : "pbmpi " + version, core::value_in(attributes, "git_revision"),
                 core::value_in(attributes, "created")});
}

std::string page_by(const std::string& maker) { return maker.empty() ? "" : "page by " + maker; }

}  // namespace

Provenance provenance_of(const RunData& run, const std::string& maker) {
  return {joined({origin(run.attributes), page_by(maker)}), {}};
}

std::string provenance_json(const Provenance& provenance) {
  nlohmann::json entries = nlohmann::json::array();
  for (const auto& [name, text] : provenance.entries) entries.push_back({name, text});
  return dump({{"line", provenance.line}, {"entries", entries}});
}

}  // namespace pbmpi::io::html
