#include "io/html/page_template.h"

#include <cerrno>
#include <filesystem>
#include <fstream>

#include "core/error.h"
#include "io/html/assets.h"

namespace pbmpi::io::html {

std::string fill_template(std::string_view id, const std::function<std::string(std::string_view)>& field) {
  std::string page;
  std::string_view rest = asset(id);
  for (;;) {
    const std::size_t open = rest.find("{{");
    page += rest.substr(0, open);
    if (open == std::string_view::npos) return page;
    const std::size_t close = rest.find("}}", open);
    core::require_invariant(close != std::string_view::npos, "a template closes every {{");
    page += field(rest.substr(open + 2, close - open - 2));
    rest.remove_prefix(close + 2);
  }
}

void write_text(const std::string& path, const std::string& text) {
  const std::string partial = path + ".part";
  errno = 0;
  std::ofstream file(partial, std::ios::binary);
  file << text;
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
