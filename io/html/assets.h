/// Files that the page is made of, embedded in the program.
#pragma once

#include <string_view>

namespace pbmpi::io::html {

/// The text of an embedded file; '.' in its name becomes '_' ("page_css"). Throws std::logic_error for a name
/// that was not embedded.
std::string_view asset(std::string_view id);

}  // namespace pbmpi::io::html
