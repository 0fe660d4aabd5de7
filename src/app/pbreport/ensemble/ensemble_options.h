/// The command line of "pbreport ensemble".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbreport/tables/print_options.h"

namespace pbmpi::app {

/// What a sample is: a run, its worlds joined, or each world of each run.
enum class SampleOf { runs, worlds };

struct EnsembleOptions {
  bool help = false;
  std::vector<std::string> files;
  SampleOf over = SampleOf::runs;
  std::vector<double> quantiles = {0.05, 0.25, 0.5, 0.75, 0.95};
  std::vector<std::string> allowed;  ///< parameters that may differ
  bool by_body = false;
  PrintForm form = PrintForm::text;
  bool quiet = false;
  std::string table = "frames";            ///< for csv
  std::optional<std::string> csv, output;  ///< output: HDF5
};

/// Throws core::InputError with one clear message.
EnsembleOptions parse_ensemble_options(const std::vector<std::string>& args);

Manual ensemble_manual();

}  // namespace pbmpi::app
