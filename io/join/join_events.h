/// The events of a joined run.
#pragma once

#include <cstddef>
#include <vector>

#include "io/hdf5/commit_record.h"
#include "io/join/join_plan.h"
#include "io/join/join_rows.h"

namespace pbmpi::io {

/// The rows of /events, and the number of events of each kind, including those without a row.
class JoinedEvents {
 public:
  /// The events of a frame come from the part from which the frame comes. There is room for as many rows as
  /// in the file of one run (EventColumns). Throws core::InputError where several parts share frames but
  /// disagree on the events of worlds, or the events are not known.
  JoinedEvents(const std::vector<JoinPart>& parts, const JoinPlan& plan);

  std::int64_t num_rows() const { return static_cast<std::int64_t>(rows_.size()); }
  const EventCounts& counts() const { return counts_; }
  void write(hid_t to) const;

 private:
  std::vector<std::vector<std::byte>> rows_;  ///< [rows] bytes of the columns in order
  EventCounts counts_;
};

}  // namespace pbmpi::io
