/// What of a run's file decides whether and how it is joined to others.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace pbmpi::io {

/// A frame, counted from the start of the first run, and the number of steps done at its end.
struct FrameNumber {
  std::int64_t frame = 0, step = 0;
};

struct RunOutline {
  std::map<std::string, std::string> attributes;  ///< of the root
  std::map<std::string, std::string> parameters;
  std::vector<std::string> hosts;   ///< [R]
  std::vector<FrameNumber> frames;  ///< [T] that are committed
  std::int64_t record_every = 1;
};

/// Throws core::InputError as read_run() does, and also where a committed row has changed since it was
/// written.
RunOutline read_outline(const std::string& path);

}  // namespace pbmpi::io
