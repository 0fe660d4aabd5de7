#include "app/common/text_output.h"

#include <ostream>

#include "core/error.h"

namespace pbmpi::app {

void require_printed(std::ostream& out, const std::string& what) {
  out.flush();
  if (!out) throw core::RunError(what + " cannot be written to standard output; is the disk full?");
}

}  // namespace pbmpi::app
