/// How the pages are put together.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace pbmpi::io::html {

/// `text` with each {{name}} replaced by what `field` gives for it.
std::string fill_template(std::string_view text, const std::function<std::string(std::string_view)>& field);

}  // namespace pbmpi::io::html
