#include "io/html/fill_template.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

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

void write_whole_page(const std::string& path, const std::string& page) {
  const std::string partial = path + ".part";
  errno = 0;
  std::ofstream file(partial, std::ios::binary);
  file << page;
  file.close();
  std::error_code error(file ? 0 : (errno != 0 ? errno : EIO), std::generic_category());
  if (!error) std::filesystem::rename(partial, path, error);
  if (error) {
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    throw core::InputError(path + ": the page cannot be written (" + error.message() +
                           "); choose another place");
  }
}

}  // namespace pbmpi::io::html
