/// The paper's five error categories (section 5.3), and summaries of sets of errors.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "analysis/pose_errors.h"

namespace pbmpi::analysis {

inline constexpr int num_bands = 5;
using BandCounts = std::array<std::int64_t, num_bands>;

/// Edges of the position categories [m]: < 1 cm, 1 to 10 cm, 10 to 100 cm, > 100 cm; then inf or NaN.
inline constexpr std::array<double, 3> position_edges_m = {0.01, 0.1, 1.0};
inline constexpr std::array<std::string_view, num_bands> position_band_names = {
    "< 1 cm", "1-10 cm", "10-100 cm", "> 100 cm", "inf/NaN"};
/// Edges of the orientation categories as shares of 2 pi: < 5 %, 5 to 25 %, 25 to 50 %, > 50 %; then inf or
/// NaN. The shortest rotation between two orientations is at most 50 %, so the fourth category stays empty;
/// it is kept for comparison with the paper.
inline constexpr std::array<double, 3> orientation_edges = {0.05, 0.25, 0.5};
inline constexpr std::array<std::string_view, num_bands> orientation_band_names = {
    "< 5 %", "5-25 %", "25-50 %", "> 50 %", "inf/NaN"};

/// Index of the category of an error [m]; an error on an edge is in the worse one.
int position_band(double error_m);
/// Index of the category of an angle [rad]; half a turn is in the category 25-50 %.
int orientation_band(double angle_rad);

/// A set of errors, each in one category. All numbers are over the finite errors, 0 if there is none. A
/// broken joint has no error and is a class of its own, so that every method has as many entries.
struct ErrorSummary {
  std::int64_t count = 0;                                 ///< over all categories, and broken joints
  double rms = 0, median = 0, p90 = 0, p99 = 0, max = 0;  ///< [m] or [rad]
  BandCounts bands{};
  std::int64_t broken = 0;
};

ErrorSummary summarize_positions(std::span<const double> errors_m);
ErrorSummary summarize_orientations(std::span<const double> angles_rad);

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
