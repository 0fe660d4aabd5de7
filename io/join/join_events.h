/// The events of a joined run.
#pragma once

#include <cstddef>
#include <vector>

#include "io/hdf5/commit_record.h"
#include "io/join/join_plan.h"
#include "io/join/join_rows.h"

namespace pbmpi::io {

/// The rows of /events, and how often each kind happened, those without a row included.
class JoinedEvents {
 public:
  /// What happened in a frame is taken from the part from which the frame comes. As in the file of one run
  /// there is room for so many rows (EventColumns). Throws core::InputError where frames that several parts
  /// have do not have the same events of worlds, or these are not known.
  JoinedEvents(const std::vector<JoinPart>& parts, const JoinPlan& plan);

  std::int64_t num_rows() const { return static_cast<std::int64_t>(rows_.size()); }
  const EventCounts& counts() const { return counts_; }
  void write(hid_t to) const;

 private:
  std::vector<std::vector<std::byte>> rows_;  ///< [rows] bytes of the columns, one after the other
  EventCounts counts_;
};

}  // namespace pbmpi::io
