#include "app/pbreport/tables/print_options.h"

#include <algorithm>
#include <vector>

#include "app/common/options.h"
#include "core/error.h"
#include "core/text.h"

namespace pbmpi::app {

namespace po = boost::program_options;
using core::require_input;

void add_general_options(const std::string& printed, po::options_description& description) {
  add_help_options(description);
  description.add_options()("quiet,q",
                            ("print nothing but errors and what " + printed + " asks for").c_str());
}

void add_print_options(const std::string& markdown, po::options_description& description) {
  description.add_options()("json", "print all as one JSON document")  //
      ("markdown", markdown.c_str());
}

PrintForm print_form(const po::variables_map& values) {
  const bool json = values.count("json") != 0, markdown = values.count("markdown") != 0;
  require_input(!json || !markdown, "--json and --markdown: print one of the two");
  if (json) return PrintForm::json;
  return markdown ? PrintForm::markdown : PrintForm::text;
}

void add_table_options(std::span<const std::string_view> tables, const std::string& usual,
                       po::options_description& description) {
  std::string which = "which for --csv: ";
  for (std::size_t i = 0; i < tables.size(); ++i) which += (i == 0 ? "" : ", ") + std::string(tables[i]);
  description.add_options()                                                                         //
      ("csv", po::value<std::string>()->value_name("FILE"), "one table as comma-separated values")  //
      ("table", po::value<std::string>()->default_value(usual)->value_name("NAME"), which.c_str());
}

std::string chosen_table(const po::variables_map& values, std::span<const std::string_view> tables) {
  const auto& table = values["table"].as<std::string>();
  const std::vector<std::string> names(tables.begin(), tables.end());
  require_input(std::find(names.begin(), names.end(), table) != names.end(),
                "--table " + table + ": there is no such table" + core::suggestion(table, names));
  return table;
}

}  // namespace pbmpi::app
