/// Fills the templates of the pages.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace pbmpi::io::html {

/// `text` with each {{name}} replaced by field(name).
std::string fill_template(std::string_view text, const std::function<std::string(std::string_view)>& field);

}  // namespace pbmpi::io::html
