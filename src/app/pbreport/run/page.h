/// The page of a run: plots and a 3D replay, written by the Python package src/app/reports.
#pragma once

#include <string>

#include "app/summary/run_summary.h"
#include "core/error.h"

namespace pbmpi::app {

/// Writes the page of the run in `file` to `page`. Anything but ExitCode::done: it was refused, and standard
/// error says why. Throws core::RunError if Python cannot be started or was killed.
core::ExitCode write_page(const std::string& file, const std::string& page, const RunSummary& summary);

}  // namespace pbmpi::app
