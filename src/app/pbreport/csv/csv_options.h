/// The command line of "pbreport csv".
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "app/manual/manual.h"

namespace pbmpi::app {

/// Frames from `first` to `last`, both included, in steps of `every`; numbered as in the file's events.
struct FrameRange {
  std::int64_t first = 0, last = std::numeric_limits<std::int64_t>::max(), every = 1;

  bool has(std::int64_t frame) const {
    return frame >= first && frame <= last && (frame - first) % every == 0;
  }
};

/// "10:20", ":20", "10:", "10:20:5", "12". Throws core::InputError for anything else.
FrameRange parse_frames(const std::string& text);

struct CsvOptions {
  bool help = false, list = false;
  std::string file;
  std::string table = "bodies";
  FrameRange frames;
  bool measured_only = false;
  std::vector<int> worlds;                  ///< empty: all
  std::vector<std::string> bodies, actors;  ///< names; empty: all
  std::optional<std::string> output;
};

/// Throws core::InputError with one clear message.
CsvOptions parse_csv_options(const std::vector<std::string>& args);

Manual csv_manual();

}  // namespace pbmpi::app
