/// The summary of a run, read back from its file.
#pragma once

#include <string>

#include "app/summary/run_summary.h"
#include "io/run/run_data.h"

namespace pbmpi::app {

/// The file's observables, joined over the worlds.
ObservedFrames observed_frames(const io::RunData& run);

/// The measured frames' rows of the run's columns. Frames before the first measured one are warm-up.
MeasuredFrames measured_frames(const io::RunData& run);

/// The numbers that pbmpi printed at the end of the run; for a run that was cut off, the numbers for the
/// frames in its file. `path` names the file. Throws core::InputError if a setting is missing or not a
/// number.
RunSummary summary_from_file(const io::RunData& run, const std::string& path);

}  // namespace pbmpi::app
