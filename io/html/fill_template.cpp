#include "io/html/fill_template.h"

#include "core/error.h"

namespace pbmpi::io::html {

std::string fill_template(std::string_view text, const std::function<std::string(std::string_view)>& field) {
  std::string page;
  for (;;) {
    const std::size_t open = text.find("{{");
    page += text.substr(0, open);
    if (open == std::string_view::npos) return page;
    const std::size_t close = text.find("}}", open);
    core::require_invariant(close != std::string_view::npos, "a page's template closes every {{");
    page += field(text.substr(open + 2, close - open - 2));
    text.remove_prefix(close + 2);
  }
}

}  // namespace pbmpi::io::html
