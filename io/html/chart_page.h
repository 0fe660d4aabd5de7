/// A self-contained HTML page of charts and tables. It loads nothing from anywhere.
#pragma once

#include <string>
#include <vector>

#include "io/html/provenance.h"

namespace pbmpi::io::html {

/// One chart: a configuration of Chart.js 3 as JSON text (type, data, options). Two additions: in
/// "options.plugins.pbmpi", {"bands": [{"from", "to", "label", "colour"}]} draws bands behind the data, at
/// values of the y axis or of the axis that "axis" names; where both ends are equal it draws a line, dashed
/// by "dash". Values off the scale get an arrow. {"key": [{"label", "shape", "radius", "colour"}]} adds to
/// the key below the chart, which names data sets and bands with their values ("showValue": false: without).
/// A point's "label" is the text read off it. The keyboard skips a data set with "unread".
struct Chart {
  std::string title;
  std::string text;    ///< one line below the title
  std::string config;  ///< JSON
};

struct TextTable {
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
};

/// A heading with its text, charts and tables.
struct PageSection {
  std::string title;
  std::string text = {};  ///< paragraphs, separated by an empty line
  std::vector<Chart> charts = {};
  std::vector<TextTable> tables = {};
};

struct ChartPage {
  std::string title;
  std::string subtitle;
  std::vector<PageSection> sections;
  Provenance provenance = {};
};

std::string make_chart_page(const ChartPage& page);

/// Writes the page through a temporary file next to it. Throws core::InputError if it cannot be written.
void write_chart_page(const std::string& path, const ChartPage& page);

}  // namespace pbmpi::io::html
