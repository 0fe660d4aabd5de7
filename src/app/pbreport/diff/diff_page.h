/// The HTML page of "pbreport diff --html".
#pragma once

#include <string>

#include "app/pbreport/diff/run_comparison.h"
#include "io/html/provenance.h"

namespace pbmpi::app {

/// Curves over the compared frames: drift, and how far both runs are from their constraints; then actors.
/// `run`, `reference`: each file's name and attributes. Throws core::InputError if it cannot be written.
void write_diff_page(const std::string& path, const RunComparison& comparison,
                     const io::html::FileAttributes& run, const io::html::FileAttributes& reference);

}  // namespace pbmpi::app
