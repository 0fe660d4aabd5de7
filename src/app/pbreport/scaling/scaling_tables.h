/// Curves of scaling as the tables of CSV and of JSON.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "app/pbreport/scaling/scaling_curves.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// One row per point of a curve; per phase of a point; per run of a point.
inline constexpr std::array<std::string_view, 3> scaling_table_names = {"points", "phases", "runs"};

io::TableFile scaling_tables(const std::vector<ScalingCurve>& curves);

}  // namespace pbmpi::app
