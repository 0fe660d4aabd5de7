/// A study of stability read back.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "io/table/table_file.h"
#include "stability/cases/verdict.h"

namespace pbmpi::app {

/// A row of /cases.
struct StabilityCell {
  std::size_t index = 0;  ///< index of the row
  std::string setting;
  double dt_s = 0;
  stability::Judgement judged;
  std::array<double, stability::num_metrics> metrics{};
  double broken_at_s = 0, simulated_s = 0;
  double row_visits = 0;   ///< per step, mean
  double step_time_s = 0;  ///< mean
  int drift_band = 0;      ///< the paper's category for the body that drifted farthest
};

/// A hard case under all settings of the study.
struct StabilityScene {
  std::string name, group, oracle, source;
  int row = 0, bodies = 0;
  double seconds = 0;
  std::vector<StabilityCell> cells;  ///< [num_settings]
};

struct StabilityMap {
  std::vector<std::string> settings;
  std::vector<StabilityScene> scenes;  ///< in the order of the file
};

/// `names`: scenes; empty: all. Throws core::InputError for a scene that is not in the file.
StabilityMap stability_map(const io::TableFile& file, const std::vector<std::string>& names);

/// How many of a setting's cases have each verdict.
std::array<int, stability::verdict_names.size()> count_verdicts(const StabilityMap& map, std::size_t setting);

std::string_view name_of(stability::Verdict verdict);
/// "drift 12.3 mm", "sink 1.2 m at 3.1 s" for a broken case; empty where the setting could not run it.
std::string decided_text(const StabilityCell& cell);

}  // namespace pbmpi::app
