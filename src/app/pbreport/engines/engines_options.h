/// The command line of "pbreport engines".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbreport/tables/print_options.h"

namespace pbmpi::app {

struct EnginesOptions {
  bool help = false;
  std::optional<std::string> accuracy, stability;  ///< the studies' files; at least one of them
  std::vector<std::string> scenes;                 ///< of the accuracy study; empty: all
  std::optional<std::string> html;
  PrintForm form = PrintForm::text;
  bool quiet = false;
};

/// Throws core::InputError with one clear message.
EnginesOptions parse_engines_options(const std::vector<std::string>& args);

}  // namespace pbmpi::app
