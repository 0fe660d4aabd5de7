/// The destination of warnings.
#pragma once

#include <functional>
#include <string>

namespace pbmpi::ode {

/// Takes one human-readable line without a newline, e.g. "ode: world 3, step 17: LCP internal error ...".
using WarningSink = std::function<void(const std::string& line)>;

/// Writes the line to standard error.
void warn_on_stderr(const std::string& line);

}  // namespace pbmpi::ode
