/// How far a recorded run is from satisfying its own constraints: joints, and contacts if they are recorded.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/error_bands.h"
#include "app/pbreport/run/run_models.h"

namespace pbmpi::app {

/// Over the measured frames that are recorded. Every method has the same number of joint entries: broken
/// joints are a class of their own.
struct ConstraintErrors {
  analysis::ErrorSummary joint_gap;   ///< [m] distance between a joint's two halves
  analysis::ErrorSummary joint_bend;  ///< [rad] rotation about axes that the joint locks
  /// [m] penetration depth of each contact of the last step of a frame; none without --record-contacts.
  std::optional<analysis::ErrorSummary> penetration;
  /// [m] displacement along the surface, in that step, of a contact whose friction is below 99 % of its
  /// limit: it should stick.
  std::optional<analysis::ErrorSummary> slip;
  std::int64_t passages = 0;  ///< bodies that passed through something, as the run's guards saw it
};

/// The four error summaries, by their names in reports.
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

/// Constraint errors of a whole run, and by frame and by actor.
struct RunConstraints {
  ConstraintErrors all;
  std::vector<ConstraintErrors> by_frame;  ///< [rows] for the rows asked for, without passages
  /// [actors] in the order of actors_of(), without passages, over the frames of `all`. A joint counts for the
  /// actor of its first body, a contact for both actors.
  std::vector<ConstraintErrors> by_actor;
};

/// `rows`: the recorded rows for by_frame; `path`: the run's file.
RunConstraints constraint_errors(const RunModels& models, const io::RunData& run, const std::string& path,
                                 const std::vector<std::size_t>& rows);

}  // namespace pbmpi::app
