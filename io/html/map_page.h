/// A self-contained HTML page of a map with one row per case and one column per setting, whose fields open
/// curves and a replay. It loads nothing from anywhere.
#pragma once

#include <string>
#include <vector>

#include "io/html/provenance.h"
#include "io/run/run_data.h"

namespace pbmpi::io::html {

struct MapCurve {
  std::string title, unit;
  std::vector<double> time_s, value;
};

struct MapCell {
  std::string verdict;  ///< "pass", "degraded", "broken", "n/a"
  std::string label;    ///< a few words; may be empty
  std::string detail;   ///< a line that is shown on a click
  double severity = 0;  ///< 0 to 1: how far outside the acceptable range
  std::vector<MapCurve> curves;
  RunData replay;  ///< bodies, geoms and recorded poses of one world; without poses there is no replay
};

struct MapRow {
  std::string name, group;
  std::string oracle;  ///< what should happen
  std::string source;
  std::vector<MapCell> cells;  ///< [columns]
};

struct MapPage {
  std::string title, subtitle;
  std::vector<std::string> columns;
  std::vector<MapRow> rows;
  Provenance provenance = {};
};

/// Writes the page through a temporary file next to it. Throws core::InputError if it cannot be written.
void write_map_page(const std::string& path, const MapPage& page);

}  // namespace pbmpi::io::html
