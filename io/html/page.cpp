#include "io/html/page.h"

#include <nlohmann/json.hpp>

#include "io/file/write_file.h"
#include "io/html/assets.h"
#include "io/html/escape.h"
#include "io/html/fill_template.h"
#include "io/html/plot_data.h"
#include "io/html/provenance.h"
#include "io/html/replay_data.h"

namespace pbmpi::io::html {
namespace {

using nlohmann::json;

std::string text_or(const std::map<std::string, std::string>& texts, const std::string& key,
                    const std::string& fallback) {
  const auto found = texts.find(key);
  return found == texts.end() || found->second.empty() ? fallback : found->second;
}

/// "frame 12: rebalance: 3 worlds moved", and how many more there were.
std::vector<std::string> event_lines(const RunData& run) {
  std::vector<std::string> lines;
  for (const stepping::RunEvent& event : run.events)
    lines.push_back("frame " + std::to_string(event.frame) + ": " + event.kind + ": " + event.detail);
  std::int64_t all = 0;
  for (const auto& [kind, count] : run.num_events) all += count;
  const std::int64_t more = all - std::ssize(lines);
  if (more > 0) lines.push_back("and " + std::to_string(more) + " more, for which the file has no room");
  return lines;
}

std::string about_json(const RunData& run, const PageOptions& options) {
  json about;
  about["scene"] = text_or(run.attributes, "scene", "run");
  about["complete"] = run.complete;
  about["frames_committed"] = run.frames_committed;
  about["attributes"] = run.attributes;
  about["parameters"] = run.parameters;
  about["events"] = event_lines(run);
  about["facts"] = json::array();
  for (const Fact& fact : options.facts) {
    about["facts"].push_back({{"label", fact.label}, {"value", fact.value}, {"note", fact.note}});
  }
  return dump(about);
}

/// The text of one {{field}} of page.html.
std::string field(std::string_view name, const RunData& run, const PageOptions& options) {
  if (name == "title") return escape_html(text_or(run.attributes, "scene", "run"));
  if (name == "about") return about_json(run, options);
  if (name == "plots") return plots_json(run, options.budget_s);
  if (name == "provenance") return provenance_json(provenance_of(run, options.maker));
  if (name == "replay") return replay_json(run, select_replay(run, options.max_pose_bytes));
  return std::string(asset(name));
}

}  // namespace

std::string make_page(const RunData& run, const PageOptions& options) {
  return fill_template(asset("page_html"), [&](std::string_view name) { return field(name, run, options); });
}

void write_page(const std::string& path, const RunData& run, const PageOptions& options) {
  write_file(path, make_page(run, options));
}

}  // namespace pbmpi::io::html
