/// The command line of "pbstudy calibrate".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/common/options.h"
#include "app/manual/manual.h"

namespace pbmpi::app {

struct CalibrateOptions {
  int repeats = 9;            ///< rounds in which each case is timed once
  int largest_ranks = 16384;  ///< the most ranks for which root's work is timed
  std::uint64_t seed = 1;     ///< for the order of cases in a round
  std::string output;
  CommonOptions common;
  std::string command_line;
};

/// Throws core::InputError with one clear message.
CalibrateOptions parse_calibrate_options(const std::vector<std::string>& args);

Manual calibrate_manual();

}  // namespace pbmpi::app
