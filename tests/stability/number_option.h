/// Options of test programs.
#pragma once

#include <cstdlib>
#include <cstring>

namespace pbmpi::stability {

/// The number after `name` on a command line, or `otherwise`.
inline double number_option(int argc, char** argv, const char* name, double otherwise) {
  for (int i = 1; i + 1 < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) return std::strtod(argv[i + 1], nullptr);
  }
  return otherwise;
}

}  // namespace pbmpi::stability
