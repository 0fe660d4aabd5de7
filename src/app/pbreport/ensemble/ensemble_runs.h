/// The runs of an ensemble: what they share, and how they differ.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/pbreport/ensemble/ensemble_options.h"
#include "io/extract/run_tables.h"

namespace pbmpi::app {

class EnsembleRuns {
 public:
  /// Opens all runs. Throws core::InputError for runs with different bodies, scenes or settings (except those
  /// that the options allow), the same seeds twice, or frames at different times.
  explicit EnsembleRuns(const EnsembleOptions& options);

  const std::vector<io::RunTables>& runs() const { return runs_; }
  const io::RunTables& first() const { return runs_.front(); }
  /// Frames, and frames with positions, that all runs have.
  std::int64_t num_frames() const { return num_frames_; }
  std::int64_t num_recorded() const { return num_frames_ / first().record_every(); }
  SampleOf over() const { return over_; }
  std::int64_t num_samples() const;
  /// Bodies of a sample: all, or those of one world.
  std::int64_t num_bodies() const;
  /// "ranks is 1 in a.h5 and 2 in b.h5": differences other than seeds that are allowed, or do not affect
  /// results.
  const std::vector<std::string>& differences() const { return differences_; }

 private:
  void require_comparable(const io::RunTables& run, const EnsembleOptions& options);
  void require_new_sample(std::size_t index) const;
  static void require_equal_worlds(const io::RunTables& run);

  SampleOf over_;
  std::vector<io::RunTables> runs_;
  std::vector<std::string> differences_;
  std::int64_t num_frames_ = 0;
};

}  // namespace pbmpi::app
