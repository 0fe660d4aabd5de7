/// One self-contained HTML page of all scenes: frame rates, islands and cores, next to the paper's values.
#pragma once

#include <string>
#include <vector>

#include "io/html/provenance.h"

namespace pbmpi::io::html {

struct SuiteScene {
  std::string islands_json;  ///< a row as "pbreport islands --json" prints it
  std::string cores_json;    ///< a row as "pbreport cores --json" prints it
  std::string name;
  std::string still_png;  ///< bytes of a picture; empty = none
};

/// Throws core::InputError if `path` cannot be written.
void write_suite_page(const std::string& path, const std::vector<SuiteScene>& scenes,
                      const Provenance& provenance);

}  // namespace pbmpi::io::html
