/// A run's observables, joined over its worlds, from which a summary is made, for a live run as well as for
/// its file.
#pragma once

#include <vector>

#include "app/summary/run_summary.h"
#include "stepping/observable_table.h"

namespace pbmpi::app {

/// All frames, including the warm-up.
struct ObservedFrames {
  std::vector<bool> measured;  ///< [T] false in a warm-up frame
  /// [columns of stepping::world_observables][T]; empty for vectors, and for columns that an older file
  /// lacks.
  std::vector<std::vector<double>> joined =
      std::vector<std::vector<double>>(stepping::world_observables.size());

  /// [measured frames] of one column; zeros if the column is empty.
  std::vector<double> measured_of(std::size_t column) const;
  /// Value in the last frame, or in the first; 0 without any frame.
  double last(std::size_t column) const;
  double first(std::size_t column) const;
  /// The largest over the measured frames; 0 without any.
  double largest_measured(std::size_t column) const;
};

/// Counts of contacts, rows and islands.
void take_counts(const ObservedFrames& observed, MeasuredFrames& frames);

/// Values that stay small or steady in a sound run: non-finite bodies and energy at the end, joint gap and
/// penetration over the measured frames.
void take_invariants(const ObservedFrames& observed, RunSummary& summary);

}  // namespace pbmpi::app
