/// Group /events of a run's file: what happened beside the frames, a row each, and how often in all.
#pragma once

#include <cstdint>
#include <string>

#include "io/hdf5/commit_record.h"
#include "io/hdf5/growing_columns.h"
#include "io/hdf5/parallel_file.h"
#include "io/run/run_data.h"
#include "stepping/run_event.h"

namespace pbmpi::io {

class EventColumns {
 public:
  static constexpr int max_rows = 512;
  /// Rows kept for what happens to the run and not to its worlds (rebalances, signals ...). How many of those
  /// there are depends on clocks and ranks, so they must take no row from the others: these are the same for
  /// any number of ranks, also where there is no room for all.
  static constexpr int max_rows_of_the_run = 64;
  /// Paths of the datasets.
  static std::vector<std::string> datasets();
  /// Bytes of the preallocated rows.
  static std::size_t bytes();

  /// Makes the datasets. Collective.
  EventColumns(hid_t file, const FileRanks& ranks);

  /// Every rank is told of the same event. Without room for its row it is counted all the same. Throws
  /// std::logic_error for a kind that event_kind does not list.
  void add(const stepping::RunEvent& event);

  GrowingTable& rows() { return rows_; }
  const GrowingTable& rows() const { return rows_; }
  /// Rows written, rows for which there was no room, and events told of each kind.
  EventCounts counts() const;
  /// Does a kind of events happen to the run? All others happen to a world.
  static bool is_of_the_run(const std::string& kind);
  /// Name of the count of a kind; of the counts that no kind has.
  static std::string count_name(const std::string& kind);
  static constexpr const char* num_rows = "num_events";
  static constexpr const char* num_dropped = "num_dropped";
  static constexpr const char* worlds_moved = "worlds_moved";
  /// Names of all counts, each zero: for the attributes of a file that begins.
  static EventCounts no_counts();

 private:
  /// Is there a row for one more event of this kind? It is then taken.
  bool take_row(const std::string& kind);

  bool is_root_;
  GrowingTable rows_;
  int rows_of_the_run_ = 0, rows_of_worlds_ = 0;
  EventCounts told_ = no_counts();
};

/// Events and their counts; those of a layout before 1.2 have neither step, world, joint, name nor value, and
/// only rows are counted.
void read_events(hid_t file, RunData& run);

}  // namespace pbmpi::io
