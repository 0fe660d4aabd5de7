/// A run's observables, joined over its worlds: what a summary takes from them, whether they come from a live
/// run or from its file.
#pragma once

#include <vector>

#include "app/summary/run_summary.h"
#include "stepping/observable_table.h"

namespace pbmpi::app {

/// All frames, those of the warm-up included.
struct ObservedFrames {
  std::vector<bool> measured;  ///< [T] false in a warm-up frame
  /// [columns of stepping::world_observables][T]; empty for vectors, and for what an older file lacks.
  std::vector<std::vector<double>> joined =
      std::vector<std::vector<double>>(stepping::world_observables.size());

  /// [measured frames] of one column; zeros where it is empty.
  std::vector<double> measured_of(std::size_t column) const;
  /// In the last frame, or in the first; 0 without any.
  double last(std::size_t column) const;
  double first(std::size_t column) const;
  /// The largest of the measured frames; 0 without any.
  double largest_measured(std::size_t column) const;
};

/// Counts of contacts, rows and islands.
void take_counts(const ObservedFrames& observed, MeasuredFrames& frames);

/// What a sound run keeps small or steady: non-finite bodies and energy at the end, joint gap and penetration
/// over the measured frames.
void take_invariants(const ObservedFrames& observed, RunSummary& summary);

}  // namespace pbmpi::app
