/// The table in the file of "pbstudy effects".
#pragma once

#include <vector>

#include "app/pbstudy/effects/effects_runner.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// Columns with one row per case (io/SCHEMA.md), with instructions only if `counted`. `results` [num_cases]
/// in the order of the cases.
std::vector<io::TableColumn> effect_columns(const std::vector<StudyScene>& scenes,
                                            const std::vector<EffectCase>& cases,
                                            const std::vector<EffectResult>& results, bool counted);

}  // namespace pbmpi::app
