/// A file of tables as JSON.
#pragma once

#include <string>

#include "io/table/table_file.h"

namespace pbmpi::app {

/// One document, with a newline at the end: the parameters by name, then one object per table with one array
/// per column; numbers that are not finite are null.
std::string to_json(const io::TableFile& file);

}  // namespace pbmpi::app
