#include "io/html/chart_page.h"

#include <nlohmann/json.hpp>

#include "io/file/write_file.h"
#include "io/html/assets.h"
#include "io/html/escape.h"
#include "io/html/fill_template.h"

namespace pbmpi::io::html {
namespace {

using nlohmann::json;

json to_json(const PageSection& section) {
  json charts = json::array(), tables = json::array();
  for (const Chart& chart : section.charts) {
    charts.push_back({{"title", chart.title}, {"text", chart.text}, {"config", json::parse(chart.config)}});
  }
  for (const TextTable& table : section.tables) {
    tables.push_back({{"title", table.title}, {"header", table.header}, {"rows", table.rows}});
  }
  return {{"title", section.title}, {"text", section.text}, {"charts", charts}, {"tables", tables}};
}

std::string field(std::string_view name, const ChartPage& page) {
  if (name == "title") return escape_html(page.title);
  if (name == "subtitle") return escape_html(page.subtitle);
  if (name == "provenance") return provenance_json(page.provenance);
  if (name != "sections") return std::string(asset(name));
  json sections = json::array();
  for (const PageSection& section : page.sections) sections.push_back(to_json(section));
  return dump(sections);
}

}  // namespace

std::string make_chart_page(const ChartPage& page) {
  return fill_template(asset("charts_html"), [&](std::string_view name) { return field(name, page); });
}

void write_chart_page(const std::string& path, const ChartPage& page) {
  write_file(path, make_chart_page(page));
}

}  // namespace pbmpi::io::html
