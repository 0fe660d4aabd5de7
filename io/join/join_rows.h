/// The rows of the tables of a joined run.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/join/copy_objects.h"
#include "io/join/join_plan.h"
#include "io/run/frame_table.h"

namespace pbmpi::io {

/// A file that is joined with others.
struct JoinPart {
  std::string path;
  hid_t file;  ///< borrowed
  std::int64_t num_ranks = 1;
};

/// A table of frames that all parts have.
struct JoinedTable {
  std::vector<std::string> columns;
  std::string checksums;  ///< path of the rows' checksums
  Rows rows = Rows::frames;
  bool has_ranks = false;  ///< has an item per rank
};

/// Tables that all parts have, and the names (first columns) of those that only some have.
struct CommonTables {
  std::vector<JoinedTable> tables;
  bool has_contacts = false;
  std::vector<std::string> of_some;
  std::set<std::string> left_out;  ///< datasets of the tables that only some have, in the first part
};
CommonTables common_tables(const std::vector<JoinPart>& parts);

/// Datasets with a row per frame or event, for everything that a run can record.
std::set<std::string> growing_datasets();

/// How the datasets of the joined file are created. Events have `num_events` rows.
std::map<std::string, GrownDataset> grown_datasets(const std::vector<JoinPart>& parts,
                                                   const CommonTables& common, const JoinPlan& plan,
                                                   std::int64_t num_events);

/// Throws core::InputError unless frames that several parts have are equal bit for bit, except times that
/// clocks have measured.
void require_equal_overlaps(const std::vector<JoinPart>& parts, const CommonTables& common,
                            const JoinPlan& plan);

/// Writes all rows except those of events, and their checksums.
void write_joined_rows(const std::vector<JoinPart>& parts, const CommonTables& common, const JoinPlan& plan,
                       hid_t to);

}  // namespace pbmpi::io
