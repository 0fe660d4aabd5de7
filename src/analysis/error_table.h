/// The errors of a world, or of many, in four summaries.
#pragma once

#include <array>

#include "analysis/error_bands.h"
#include "analysis/pose_errors.h"

namespace pbmpi::analysis {

/// Errors of all bodies and all joints, summarised.
struct ErrorTable {
  ErrorSummary body_position;      ///< [m]
  ErrorSummary body_orientation;   ///< [rad]
  ErrorSummary joint_position;     ///< [m] between the anchor gaps
  ErrorSummary joint_orientation;  ///< [rad] between the axis angles
};
ErrorTable summarize(const PoseErrors& errors);

/// The four summaries of a table, with their names in reports and files.
struct NamedSummary {
  const char* name;
  const char* unit;
  ErrorSummary ErrorTable::*summary;
};
inline constexpr std::array<NamedSummary, 4> error_columns = {{
    {"body_position", "m", &ErrorTable::body_position},
    {"body_orientation", "rad", &ErrorTable::body_orientation},
    {"joint_position", "m", &ErrorTable::joint_position},
    {"joint_orientation", "rad", &ErrorTable::joint_orientation},
}};

}  // namespace pbmpi::analysis
