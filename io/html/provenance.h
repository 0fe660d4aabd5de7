/// A page's account of the files and the programs that it was made from.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "io/run/run_data.h"

namespace pbmpi::io::html {

struct Provenance {
  std::string line;  ///< "pbmpi 0.1.0 · revision · when", always shown
  std::vector<std::pair<std::string, std::string>> entries;  ///< name and text, folded out on demand
};

/// The provenance of a run. `maker`: the program that makes the page, with its version. Its page shows its
/// attributes and parameters elsewhere.
Provenance provenance_of(const RunData& run, const std::string& maker);

/// JSON for io/html/web/base.js.
std::string provenance_json(const Provenance& provenance);

}  // namespace pbmpi::io::html
