#include "core/error.h"

namespace pbmpi::core {

void require_input(bool condition, const std::string& message) {
  if (!condition) throw InputError(message);
}

void require_invariant(bool condition, const char* what) {
  if (!condition) throw std::logic_error(std::string("internal error: ") + what);
}

}  // namespace pbmpi::core
