/// The command line of "pbreport study".
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pbmpi::app {

/// By which number of the defect settings are ranked.
enum class ErrorMeasure { rms, p99, max, joint };

struct StudyOptions {
  bool help = false;
  std::string file;
  std::vector<std::string> scenes;  ///< empty: all in the file
  ErrorMeasure measure = ErrorMeasure::rms;
  std::optional<double> budget_s;     ///< for a frame
  std::optional<double> tolerance_m;  ///< for the error
  std::optional<std::string> html, csv, preset;
  bool json = false, quiet = false;
};

/// Throws core::InputError with one clear message.
StudyOptions parse_study_options(const std::vector<std::string>& args);

std::string study_help_text();

}  // namespace pbmpi::app
