/// Group /events of a run's file: a row for each event, and the number of events of each kind.
#pragma once

#include <cstdint>
#include <string>

#include "io/hdf5/commit_record.h"
#include "io/hdf5/file_ranks.h"
#include "io/hdf5/growing_columns.h"
#include "io/run/run_data.h"
#include "stepping/run_event.h"

namespace pbmpi::io {

class EventColumns {
 public:
  static constexpr int max_rows = 512;
  /// Rows kept for events of the run rather than of its worlds (rebalances, signals ...). The number of these
  /// events depends on clocks and ranks, so they must take no row from events of worlds, which are the same
  /// for any number of ranks even where there is not room for all.
  static constexpr int max_rows_of_the_run = 64;
  /// Paths of the datasets.
  static std::vector<std::string> datasets();
  /// Bytes of the preallocated rows.
  static std::size_t bytes();

  /// Makes the datasets.
  static void create(hid_t file);
  /// Opens the datasets in the file of all ranks.
  EventColumns(hid_t file, const FileRanks& ranks);

  /// Every rank is given the same event. An event without room for its row is still counted. Throws
  /// std::logic_error for a kind that event_kind does not list.
  void add(const stepping::RunEvent& event);

  GrowingTable& rows() { return rows_; }
  const GrowingTable& rows() const { return rows_; }
  /// Rows written, rows for which there was no room, and events of each kind.
  EventCounts counts() const;
  /// Are events of this kind events of the run? All others are events of a world.
  static bool is_of_the_run(const std::string& kind);
  /// Name of the count of a kind; the names of the counts without a kind follow.
  static std::string count_name(const std::string& kind);
  static constexpr const char* num_rows = "num_events";
  static constexpr const char* num_dropped = "num_dropped";
  static constexpr const char* worlds_moved = "worlds_moved";
  /// Names of all counts, each zero: for the attributes of a new file.
  static EventCounts no_counts();

 private:
  /// Takes a row for one more event of this kind; false if there is no room.
  bool take_row(const std::string& kind);

  bool is_root_;
  GrowingTable rows_;
  int rows_of_the_run_ = 0, rows_of_worlds_ = 0;
  EventCounts told_ = no_counts();
};

/// Reads events and their counts. Events of a layout before 1.2 have neither step, world, joint, name nor
/// value, and only rows are counted.
void read_events(hid_t file, RunData& run);

}  // namespace pbmpi::io
