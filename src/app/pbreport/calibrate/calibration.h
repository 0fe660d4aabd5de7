/// The study of the harness's costs, read back.
#pragma once

#include <vector>

#include "analysis/harness/fit_costs.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

struct Calibration {
  std::vector<analysis::TimedCase> cases;
  analysis::HarnessCosts costs;  ///< fitted to the cases of one rank, of root's work and of messages
};

/// Throws core::InputError for a part unknown to this program.
Calibration calibration_of(const io::TableFile& file);

/// A cost by its name, and its unit.
struct NamedCost {
  const char* name;
  const char* unit;
  double value;
};
std::vector<NamedCost> named_costs(const analysis::HarnessCosts& costs);

}  // namespace pbmpi::app
