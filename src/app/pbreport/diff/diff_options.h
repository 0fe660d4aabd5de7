/// The command line of "pbreport diff".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/manual/manual.h"

namespace pbmpi::app {

struct DiffOptions {
  bool help = false;
  std::string run, reference;
  std::vector<std::string> floor;  ///< the reference with other solver seeds
  bool json = false;
  std::optional<std::string> html;    ///< page of curves
  std::optional<std::string> output;  ///< HDF5 file of the errors by frame and by actor
};

/// Throws core::InputError with one clear message.
DiffOptions parse_diff_options(const std::vector<std::string>& args);

Manual diff_manual();

}  // namespace pbmpi::app
