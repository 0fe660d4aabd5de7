#include "app/pbreport/csv/csv.h"

#include <ostream>

#include "app/common/text_output.h"
#include "app/pbreport/csv/csv_options.h"
#include "app/pbreport/csv/table_text.h"
#include "core/text.h"
#include "io/extract/run_tables.h"
#include "io/file/write_file.h"

namespace pbmpi::app {
namespace {

std::string list_of(const io::RunTables& run) {
  std::string text;
  for (const io::RunTable& table : run.tables())
    text += table.name + std::string(table.name.size() < 16 ? 16 - table.name.size() : 1, ' ') +
            table.meaning + "\n";
  return text;
}

const io::RunTable& table_of(const io::RunTables& run, const std::string& name) {
  std::vector<std::string> known;
  for (const io::RunTable& table : run.tables()) known.push_back(table.name);
  const io::RunTable* table = run.find(name);
  core::require_input(table != nullptr, "--table " + name + ": " + run.path() + " has no such table" +
                                            core::suggestion(name, known) + "; --list prints all");
  return *table;
}

}  // namespace

core::ExitCode run_csv(const std::vector<std::string>& args, std::ostream& out) {
  const CsvOptions options = parse_csv_options(args);
  if (options.help) {
    out << help_of(csv_manual());
    require_printed(out, "the help");
    return core::ExitCode::done;
  }
  const io::RunTables run(options.file);
  if (options.list) {
    out << list_of(run);
    require_printed(out, "the list");
    return core::ExitCode::done;
  }
  const io::RunTable& table = table_of(run, options.table);
  if (options.output) {
    io::write_file(*options.output, [&](const auto& put) { put_table(run, table, options, put); });
  } else {
    put_table(run, table, options, [&](std::string_view text) {
      out << text;
      if (!out) require_printed(out, "the table");
    });
    require_printed(out, "the table");
  }
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
