/// Curves of scaling as tables: those of CSV and of JSON.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "app/pbreport/scaling/scaling_curves.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// A row a point of a curve; a phase of a point; a run of a point.
inline constexpr std::array<std::string_view, 3> scaling_table_names = {"points", "phases", "runs"};

io::TableFile scaling_tables(const std::vector<ScalingCurve>& curves);

}  // namespace pbmpi::app
