/// The worlds and bodies of a run that a user has chosen.
#pragma once

#include <cstdint>
#include <vector>

#include "app/pbreport/csv/csv_options.h"
#include "io/extract/run_tables.h"

namespace pbmpi::app {

class ItemChoice {
 public:
  /// Throws core::InputError for choices that the run or the table does not have.
  ItemChoice(const io::RunTables& run, const io::RunTable& table, const CsvOptions& options);

  /// -1: belongs to no world, left out if worlds are chosen.
  bool has_world(std::int64_t world) const;
  /// -1: belongs to no body, left out if bodies are chosen.
  bool has_body(std::int64_t body) const;
  /// Is item `item` of the table's rows chosen? For all tables but contacts and events.
  bool has_item(std::int64_t item) const;

 private:
  std::vector<bool> world_, body_;  ///< empty: all
  io::ItemsOf items_;
  const io::RunItems* names_;
};

}  // namespace pbmpi::app
