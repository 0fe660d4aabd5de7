/// The part of a run's file that grows with the frames.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/hdf5/growing_columns.h"
#include "io/hdf5/parallel_file.h"
#include "io/run/run_file.h"

namespace pbmpi::io {

/// Numbers of rows and items of a run's file.
struct RunShape {
  std::int64_t num_bodies = 0;
  int num_worlds = 0;
  int num_ranks = 1;
  std::int64_t num_frames = 0;
  int record_every = 1;
  OptionalColumns optional;
  std::int64_t first_frame = 0;  ///< number of the file's first frame

  std::int64_t num_recorded() const { return num_frames / record_every; }
};

/// Bytes that one frame adds to the file: those of every frame, and those of a frame that is recorded.
struct FrameBytes {
  std::size_t every_frame;
  std::size_t recorded;
};
FrameBytes frame_bytes(const RunShape& shape);

/// Events that a file can hold, and the bytes of their preallocated rows.
inline constexpr int max_events = 512;
std::size_t event_bytes();

/// Makes the growing datasets, takes in frames and events, and writes what waits.
class FrameColumns {
 public:
  /// Collective.
  FrameColumns(hid_t file, const FileRanks& ranks, const stepping::WorldTable& table, const RunShape& shape);

  void add(const stepping::FrameRecord& frame);
  void add(const stepping::RunEvent& event);
  /// No room for another frame: write() first.
  bool full() const { return frames_.full(); }
  bool empty() const { return frames_.num_waiting() == 0 && events_.num_waiting() == 0; }
  std::int64_t frames_written() const { return static_cast<std::int64_t>(frames_.num_rows()); }
  std::int64_t events_written() const { return static_cast<std::int64_t>(events_.num_rows()); }
  std::int64_t events_dropped() const { return events_dropped_; }

  /// Collective. The first error of this rank, empty if there was none.
  std::string write(const PropertyList& transfer);
  bool wrote_collectively() const { return wrote_collectively_; }
  /// Closes the datasets.
  void close();
  /// Cuts all to what was written, in the closed file that one rank has opened anew; returns the bytes of the
  /// file that this frees.
  std::vector<ByteRange> cut(hid_t file);

 private:
  std::vector<GrowingTable*> tables();
  void add_bodies(const stepping::FrameRecord& frame);
  void add_observables(const stepping::FrameRecord& frame);
  void add_residuals(const stepping::FrameRecord& frame);
  void add_interest(const stepping::FrameRecord& frame);
  void add_profiles(const stepping::FrameRecord& frame);
  void add_times(const stepping::FrameRecord& frame);
  void add_estimate(const stepping::FrameRecord& frame);

  const FileRanks& ranks_;
  const stepping::WorldTable& table_;
  /// Are the bodies of this frame stored?
  bool is_recorded(const stepping::FrameRecord& frame) const {
    return (frame.frame - first_frame_ + 1) % record_every_ == 0;
  }

  int record_every_;
  std::int64_t first_frame_;
  std::int64_t next_frame_;
  std::int64_t events_dropped_ = 0;
  bool wrote_collectively_ = false;
  GrowingTable bodies_;                    ///< [P][N][width]
  GrowingTable recorded_;                  ///< [P] step and time of the above
  GrowingTable worlds_;                    ///< [T][W]
  GrowingTable frames_;                    ///< [T]
  GrowingTable phases_;                    ///< [T][R]
  GrowingTable events_;                    ///< [E]
  std::optional<GrowingTable> residuals_;  ///< [T][W] if they are measured
  std::optional<GrowingTable> interest_;   ///< [T][W] with a field of interest
  // With step profiles:
  std::optional<GrowingTable> islands_;  ///< [T][N] at the island's lowest body
  std::optional<GrowingTable> spaces_;   ///< [T][W]
  // With FEEC:
  std::optional<GrowingTable> estimated_bodies_;  ///< [P][N][width]
  std::optional<GrowingTable> estimate_times_;    ///< [T]
  std::optional<GrowingTable> estimate_compute_;  ///< [T][R]
};

}  // namespace pbmpi::io
