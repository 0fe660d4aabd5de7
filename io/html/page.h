/// One self-contained HTML page of a run: plots and a 3D replay. It loads nothing from anywhere.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/run/run_data.h"
#include "stepping/frame.h"

namespace pbmpi::io::html {

/// A number that the page's head shows, e.g. {"Frame rate", "312 Hz", "harmonic mean of 5 frames"}.
struct Fact {
  std::string label;
  std::string value;
  std::string note;
};

struct PageOptions {
  std::vector<Fact> facts;
  /// Room for the recorded poses; the rest of a page takes about 1.5 MB. Where a run needs more, the page
  /// shows fewer worlds or every k-th frame, and says so.
  std::int64_t max_pose_bytes = 28'000'000;
  double budget_s = stepping::default_frame_budget_s;  ///< deadline of a frame
  std::string maker = {};                              ///< the program that makes the page, with its version
};

/// The page's text.
std::string make_page(const RunData& run, const PageOptions& options);

/// Writes make_page() to `path` through a temporary file next to it, so that no partial page is left. Throws
/// core::InputError if it cannot be written.
void write_page(const std::string& path, const RunData& run, const PageOptions& options);

}  // namespace pbmpi::io::html
