#include "analysis/error_bands.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/statistics.h"

namespace pbmpi::analysis {
namespace {

ErrorSummary summarize(std::span<const double> errors, int (*band_of)(double)) {
  ErrorSummary summary;
  summary.count = std::ssize(errors);
  std::vector<double> finite;
  finite.reserve(errors.size());
  double squares = 0;
  for (const double error : errors) {
    ++summary.bands[static_cast<std::size_t>(band_of(error))];
    if (!std::isfinite(error)) continue;
    finite.push_back(error);
    squares += error * error;
  }
  if (finite.empty()) return summary;
  summary.rms = std::sqrt(squares / static_cast<double>(finite.size()));
  summary.max = *std::max_element(finite.begin(), finite.end());
  summary.median = core::quantile(finite, 0.5);
  summary.p90 = core::quantile(finite, 0.9);
  summary.p99 = core::quantile(std::move(finite), 0.99);
  return summary;
}

}  // namespace

ErrorTable summarize(const PoseErrors& errors) {
  ErrorTable table = {
      summarize_positions(errors.body_position_m), summarize_orientations(errors.body_orientation_rad),
      summarize_positions(errors.joint_position_m), summarize_orientations(errors.joint_orientation_rad)};
  for (ErrorSummary* joints : {&table.joint_position, &table.joint_orientation}) {
    joints->broken = errors.broken_joints;
    joints->count += errors.broken_joints;
  }
  return table;
}

int position_band(double error_m) {
  if (!std::isfinite(error_m)) return num_bands - 1;
  return static_cast<int>(std::upper_bound(position_edges_m.begin(), position_edges_m.end(), error_m) -
                          position_edges_m.begin());
}

int orientation_band(double angle_rad) {
  if (!std::isfinite(angle_rad)) return num_bands - 1;
  const double share = angle_rad / (2 * std::numbers::pi);
  if (share == orientation_edges.back()) return 2;
  return static_cast<int>(std::upper_bound(orientation_edges.begin(), orientation_edges.end(), share) -
                          orientation_edges.begin());
}

ErrorSummary summarize_positions(std::span<const double> errors_m) {
  return summarize(errors_m, position_band);
}

ErrorSummary summarize_orientations(std::span<const double> angles_rad) {
  return summarize(angles_rad, orientation_band);
}

}  // namespace pbmpi::analysis
