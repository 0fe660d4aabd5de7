/// How far a recorded run is from what its own constraints ask for: joints, and contacts if they are
/// recorded.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/error_bands.h"
#include "app/pbreport/run/run_models.h"

namespace pbmpi::app {

/// Over the measured frames that are recorded. Entries of joints are as many for every method: what is broken
/// is a class of its own.
struct ConstraintErrors {
  analysis::ErrorSummary joint_gap;   ///< [m] distance of what a joint holds together
  analysis::ErrorSummary joint_bend;  ///< [rad] by which it is turned where it must not turn
  /// [m] depth of each contact of the last step of a frame; none without --record-contacts.
  std::optional<analysis::ErrorSummary> penetration;
  /// [m] way along the surface, in that step, of a contact whose friction is below 99 % of what it can be: it
  /// should stick.
  std::optional<analysis::ErrorSummary> slip;
  std::int64_t passages = 0;  ///< bodies that went through something, as the run's guards saw it
};

/// The four sums by the names that they have in reports.
struct NamedConstraint {
  const char* name;
  const char* unit;
  const analysis::ErrorSummary* (*summary)(const ConstraintErrors& errors);  ///< null: not recorded
};
inline constexpr std::array<NamedConstraint, 4> constraint_columns = {{
    {"joint_gap", "m", [](const ConstraintErrors& e) { return &e.joint_gap; }},
    {"joint_bend", "rad", [](const ConstraintErrors& e) { return &e.joint_bend; }},
    {"penetration", "m", [](const ConstraintErrors& e) { return e.penetration ? &*e.penetration : nullptr; }},
    {"slip", "m", [](const ConstraintErrors& e) { return e.slip ? &*e.slip : nullptr; }},
}};

/// The same, and part by part.
struct RunConstraints {
  ConstraintErrors all;
  std::vector<ConstraintErrors> by_frame;  ///< [rows] that were asked for, without passages
  /// [actors] as actors_of() has them, without passages, over the frames of `all`. A joint counts for the
  /// actor of its first body, a contact for those of both.
  std::vector<ConstraintErrors> by_actor;
};

/// `rows`: recorded rows that by_frame is to have; `path`: the run's file.
RunConstraints constraint_errors(const RunModels& models, const io::RunData& run, const std::string& path,
                                 const std::vector<std::size_t>& rows);

}  // namespace pbmpi::app
