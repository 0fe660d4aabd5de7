/// A table of a run as text.
#pragma once

#include <functional>
#include <string_view>

#include "app/pbreport/csv/csv_options.h"
#include "io/extract/run_tables.h"

namespace pbmpi::app {

/// Hands out the chosen rows, one line per item of each row, after the names of the columns and their units.
/// Throws core::InputError for choices that the run does not have.
void put_table(const io::RunTables& run, const io::RunTable& table, const CsvOptions& options,
               const std::function<void(std::string_view)>& put);

}  // namespace pbmpi::app
