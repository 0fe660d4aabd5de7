/// The command line of "pbreport effects".
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pbmpi::app {

struct EffectsReportOptions {
  bool help = false;
  std::string file;
  std::vector<std::string> scenes;  ///< empty: all in the file
  std::optional<std::string> html, csv;
  bool json = false, markdown = false, quiet = false;
};

/// Throws core::InputError with one clear message.
EffectsReportOptions parse_effects_report_options(const std::vector<std::string>& args);

std::string effects_report_help_text();

}  // namespace pbmpi::app
