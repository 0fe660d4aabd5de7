/// Pages from embedded templates.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace pbmpi::io::html {

/// The embedded file `id` with each {{name}} replaced by field(name).
std::string fill_template(std::string_view id, const std::function<std::string(std::string_view)>& field);

/// Writes `text` to `path`, by way of a temporary file beside it, so that no half page is left. Throws
/// core::InputError if it cannot be written.
void write_text(const std::string& path, const std::string& text);

}  // namespace pbmpi::io::html
