/// Text on standard output.
#pragma once

#include <iosfwd>
#include <string>

namespace pbmpi::app {

/// Throws core::RunError if not everything printed to `out` has arrived. `what`: e.g. "the report".
void require_printed(std::ostream& out, const std::string& what);

}  // namespace pbmpi::app
