/// The tables of a run's file as the file stores them, some rows at a time, for export.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/table/table_file.h"

namespace pbmpi::io {

/// The items of a row; run: the row has one item. Contacts: as many as the frame had.
enum class ItemsOf { run, ranks, worlds, bodies, joints, contacts };

/// What a row describes: a frame, a frame in which the motion of bodies was stored, an event, or the whole
/// run.
enum class RowsOf { frames, recorded, events, run };

struct RunTable {
  std::string name;     ///< e.g. "bodies"
  std::string meaning;  ///< for people
  ItemsOf items = ItemsOf::run;
  RowsOf rows = RowsOf::frames;
  std::vector<std::string> columns;  ///< paths of datasets
};

/// The time of a frame, counted from the start of the first run.
struct FrameTime {
  std::int64_t frame = 0, step = 0;
  double time_s = 0;
  bool is_measured = false;
};

/// The names of the items of rows, in the order of the file.
struct RunItems {
  int num_worlds = 0;
  std::vector<std::int64_t> world_id;                     ///< [W] numbers in the ensemble
  std::vector<std::int64_t> body_world;                   ///< [N]
  std::vector<std::string> body_name, actor, actor_kind;  ///< [N]
  std::vector<std::int64_t> joint_world;                  ///< [J]; empty before layout 1.5, as is the next
  std::vector<std::string> joint_name;
  std::vector<std::string> hosts;  ///< [R]
};

/// Reads the committed rows of a run's file, which stays open.
class RunTables {
 public:
  /// Throws core::InputError as read_run() does, and also where a committed row has changed since it was
  /// written.
  explicit RunTables(const std::string& path);
  ~RunTables();
  RunTables(RunTables&&) noexcept;
  RunTables& operator=(RunTables&&) noexcept;

  const std::string& path() const { return path_; }
  const std::map<std::string, std::string>& attributes() const { return attributes_; }  ///< of the root
  const std::map<std::string, std::string>& parameters() const { return parameters_; }
  const RunItems& items() const { return items_; }
  const std::vector<FrameTime>& frames() const { return frames_; }  ///< [T]
  std::int64_t record_every() const { return record_every_; }

  /// The tables that the file has.
  const std::vector<RunTable>& tables() const { return tables_; }
  /// The table of this name; null if the file has none.
  const RunTable* find(const std::string& name) const;
  std::int64_t num_rows(const RunTable& table) const;
  /// The frame of a row; not for events, which have a column of their own, nor for the run.
  const FrameTime& frame_of(const RunTable& table, std::int64_t row) const;
  /// Number of items of a row.
  std::int64_t num_items(const RunTable& table, std::int64_t row) const;

  /// Columns of the rows [first, first + count): the values of one row's items after those of the previous
  /// row's. Throws core::InputError where they cannot be read.
  std::vector<TableColumn> read(const RunTable& table, std::int64_t first, std::int64_t count) const;
  /// Reads a whole column that is written once, e.g. "/particles/bodies/mass".
  TableColumn read_once(const std::string& path) const;

 private:
  struct Impl;
  void find_tables();
  void find_tables_of_the_run();

  std::string path_;
  std::unique_ptr<Impl> impl_;
  std::map<std::string, std::string> attributes_, parameters_;
  RunItems items_;
  std::vector<FrameTime> frames_;
  std::int64_t record_every_ = 1, num_events_ = 0;
  std::vector<RunTable> tables_;
};

}  // namespace pbmpi::io
