/// How the pages are put together and written.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace pbmpi::io::html {

/// `text` with each {{name}} replaced by what `field` gives for it.
std::string fill_template(std::string_view text, const std::function<std::string(std::string_view)>& field);

/// Writes a page by way of a temporary file beside it, so that no half page is left. Throws core::InputError
/// if it cannot be written.
void write_whole_page(const std::string& path, const std::string& page);

}  // namespace pbmpi::io::html
