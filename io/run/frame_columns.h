/// The part of a run's file that grows with the frames.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "io/hdf5/file_ranks.h"
#include "io/hdf5/growing_columns.h"
#include "io/run/contact_rows.h"
#include "io/run/event_columns.h"
#include "io/run/frame_table.h"

namespace pbmpi::io {

/// Bytes that one frame adds to the file: those of every frame, and those added only by a recorded frame.
struct FrameBytes {
  std::size_t every_frame;
  std::size_t recorded;
};
FrameBytes frame_bytes(const RunShape& shape);

/// A growing dataset, and how many of its rows are written or wait.
struct ColumnRows {
  std::string path;
  hsize_t rows;
  int frames_per_row;
};

/// The growing datasets: takes in frames and events, and writes the waiting rows.
class FrameColumns {
 public:
  /// Makes the datasets.
  static void create(hid_t file, const RunShape& shape);
  /// Opens the datasets in the file of all ranks. Collective. `setup` matters for the tables of worlds.
  FrameColumns(hid_t file, const FileRanks& ranks, const RunSetup& setup, const RunShape& shape);

  void add(const stepping::FrameRecord& frame);
  void add(const stepping::RunEvent& event) { events_.add(event); }
  /// No room for another frame: write() first.
  bool full() const { return frames_added_ - frames_written_ == frames_held_; }
  bool empty() const { return frames_added_ == frames_written_ && events_.rows().num_waiting() == 0; }
  std::int64_t frames_written() const { return frames_written_; }
  EventCounts event_counts() const { return events_.counts(); }

  /// All growing datasets except those of events.
  std::vector<ColumnRows> column_rows() const;
  /// Number of frames that fill this many bytes, at least one.
  hsize_t frames_in(std::size_t bytes) const;

  /// Sends the waiting rows to the ranks that write them, and determines where rows are written whose number
  /// is not fixed. Collective, before column_rows() and write().
  void settle();
  /// Writes the settled rows of this rank.
  void write();
  /// Closes the datasets.
  void close();
  /// Cuts all datasets to what was written, in the closed file that one rank has opened anew; returns the
  /// bytes of the file that this frees.
  std::vector<core::ByteRange> cut(hid_t file);

 private:
  std::vector<GrowingTable*> tables();
  /// Are the bodies of this frame stored?
  bool is_recorded(const stepping::FrameRecord& frame) const {
    return (frame.frame - first_frame_ + 1) % record_every_ == 0;
  }

  const FileRanks& ranks_;
  stepping::WorldTable table_;
  int record_every_;
  std::size_t bytes_each_;  ///< of an average frame
  std::int64_t first_frame_;
  std::int64_t frames_held_;  ///< frames that can wait
  std::int64_t frames_added_ = 0, frames_written_ = 0;
  std::vector<FrameTable> groups_;
  std::deque<GrowingTable> rows_;  ///< [groups]
  EventColumns events_;
  std::vector<std::int64_t> joint_offset_;  ///< [num_worlds + 1]
  std::optional<ContactRows> contacts_;
};

}  // namespace pbmpi::io
