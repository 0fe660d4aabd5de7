/// A file of tables as JSON.
#pragma once

#include <string>

#include "io/table/table_file.h"

namespace pbmpi::app {

/// One document, with a newline at the end: the parameters by name, then an object a table with an array a
/// column; what is not finite is null.
std::string to_json(const io::TableFile& file);

}  // namespace pbmpi::app
