#include "app/summary/observed_frames.h"

#include <algorithm>

namespace pbmpi::app {

using stepping::column_of;
using stepping::Observables;

std::vector<double> ObservedFrames::measured_of(std::size_t column) const {
  std::vector<double> picked;
  for (std::size_t frame = 0; frame < measured.size(); ++frame) {
    if (measured[frame]) picked.push_back(joined[column].empty() ? 0 : joined[column][frame]);
  }
  return picked;
}

double ObservedFrames::last(std::size_t column) const {
  return joined[column].empty() ? 0 : joined[column].back();
}

double ObservedFrames::first(std::size_t column) const {
  return joined[column].empty() ? 0 : joined[column].front();
}

double ObservedFrames::largest_measured(std::size_t column) const {
  double largest = 0;
  for (const double value : measured_of(column)) largest = std::max(largest, value);
  return largest;
}

void take_counts(const ObservedFrames& observed, MeasuredFrames& frames) {
  frames.islands = observed.measured_of(column_of(&Observables::islands));
  frames.contacts = observed.measured_of(column_of(&Observables::contacts));
  frames.rows = observed.measured_of(column_of(&Observables::rows));
  frames.max_island_rows = observed.measured_of(column_of(&Observables::max_island_rows));
}

void take_invariants(const ObservedFrames& observed, RunSummary& summary) {
  summary.energy_j = observed.last(column_of(&Observables::energy_j));
  summary.nonfinite_bodies = static_cast<std::int64_t>(observed.last(column_of(&Observables::nonfinite)));
  summary.max_joint_gap_m = observed.largest_measured(column_of(&Observables::joint_gap_m));
  summary.max_penetration_m = observed.largest_measured(column_of(&Observables::max_penetration_m));
}

}  // namespace pbmpi::app
