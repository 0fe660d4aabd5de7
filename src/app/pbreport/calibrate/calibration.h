/// A study of the harness' costs read back.
#pragma once

#include <vector>

#include "analysis/harness/fit_costs.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

struct Calibration {
  std::vector<analysis::TimedCase> cases;
  analysis::HarnessCosts costs;  ///< fitted to the cases of one rank, of root and of messages
};

/// Throws core::InputError for a part that this program does not know.
Calibration calibration_of(const io::TableFile& file);

/// A cost by its name, and its unit.
struct NamedCost {
  const char* name;
  const char* unit;
  double value;
};
std::vector<NamedCost> named_costs(const analysis::HarnessCosts& costs);

}  // namespace pbmpi::app
