/// Text on standard output.
#pragma once

#include <iosfwd>
#include <string>

namespace pbmpi::app {

/// Throws core::RunError if what was printed to `out` has not all arrived. `what`: e.g. "the report".
void require_printed(std::ostream& out, const std::string& what);

}  // namespace pbmpi::app
