#include "app/common/text_output.h"

#include <fstream>

#include "core/error.h"

namespace pbmpi::app {

void write_text(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text << std::flush;
  core::require_input(file.good(), path + ": it cannot be written; choose another place");
}

void require_printed(std::ostream& out, const std::string& what) {
  out.flush();
  if (!out) throw core::RunError(what + " cannot be written to standard output; is the disk full?");
}

}  // namespace pbmpi::app
