/// The file of "pbstudy accuracy".
#pragma once

#include <vector>

#include "app/pbstudy/accuracy/case_runner.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// Columns with one row per case (io/SCHEMA.md). `results` [num_cases] in the order of the cases.
std::vector<io::TableColumn> case_columns(const std::vector<StudyScene>& scenes,
                                          const std::vector<AccuracyCase>& cases,
                                          const std::vector<CaseResult>& results);

}  // namespace pbmpi::app
