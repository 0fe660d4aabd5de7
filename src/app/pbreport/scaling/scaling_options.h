/// The command line of "pbreport scaling".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbreport/scaling/scaling_curves.h"
#include "app/pbreport/tables/print_options.h"

namespace pbmpi::app {

struct ScalingOptions {
  bool help = false;
  std::vector<std::string> files;
  ScalingRules rules;
  PrintForm form = PrintForm::text;
  bool quiet = false;
  std::string table = "points";  ///< for csv
  std::optional<std::string> csv, html;
};

/// Throws core::InputError with one clear message.
ScalingOptions parse_scaling_options(const std::vector<std::string>& args);

Manual scaling_manual();

}  // namespace pbmpi::app
