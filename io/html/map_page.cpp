#include "io/html/map_page.h"

#include <limits>
#include <nlohmann/json.hpp>

#include "io/file/write_file.h"
#include "io/html/assets.h"
#include "io/html/base64.h"
#include "io/html/escape.h"
#include "io/html/fill_template.h"
#include "io/html/replay_data.h"

namespace pbmpi::io::html {
namespace {

using nlohmann::json;

std::string numbers(const std::vector<double>& values) {
  return base64_of(std::vector<float>(values.begin(), values.end()));
}

json to_json(const MapCell& cell) {
  json curves = json::array();
  for (const MapCurve& curve : cell.curves) {
    curves.push_back({{"title", curve.title},
                      {"unit", curve.unit},
                      {"time_s", numbers(curve.time_s)},
                      {"value", numbers(curve.value)}});
  }
  json replay;
  if (!cell.replay.position.empty()) {
    constexpr auto all = std::numeric_limits<std::int64_t>::max() / 4;
    replay = json::parse(replay_json(cell.replay, select_replay(cell.replay, all)));
  }
  return {{"verdict", cell.verdict},   {"label", cell.label}, {"detail", cell.detail},
          {"severity", cell.severity}, {"curves", curves},    {"replay", replay}};
}

std::string map_json(const MapPage& page) {
  json rows = json::array();
  for (const MapRow& row : page.rows) {
    json cells = json::array();
    for (const MapCell& cell : row.cells) cells.push_back(to_json(cell));
    rows.push_back({{"name", row.name},
                    {"group", row.group},
                    {"oracle", row.oracle},
                    {"source", row.source},
                    {"cells", cells}});
  }
  return dump({{"columns", page.columns}, {"rows", rows}});
}

std::string field(std::string_view name, const MapPage& page) {
  if (name == "title") return escape_html(page.title);
  if (name == "subtitle") return escape_html(page.subtitle);
  if (name == "map") return map_json(page);
  if (name == "provenance") return provenance_json(page.provenance);
  return std::string(asset(name));
}

}  // namespace

void write_map_page(const std::string& path, const MapPage& page) {
  write_file(path,
             fill_template(asset("map_html"), [&](std::string_view name) { return field(name, page); }));
}

}  // namespace pbmpi::io::html
