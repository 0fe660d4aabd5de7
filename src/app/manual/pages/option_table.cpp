#include "app/manual/pages/option_table.h"

#include <sstream>

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

OptionRow row_of(const po::option_description& option) {
  OptionRow row{option.long_name(), {}, {}, {}, option.description()};
  const std::string names = option.format_name();  // "-o [ --output ]" or "--output"
  if (names.size() > 1 && names[1] != '-') row.short_name = names.substr(1, 1);
  const unsigned most = option.semantic()->max_tokens();
  if (most == 0) return row;
  row.takes_many = most > 1;
  row.placeholder = option.format_parameter();  // "FILE" or "N (=1)"
  const std::size_t shown = row.placeholder.find(" (=");
  if (shown == std::string::npos) return row;
  row.fallback = row.placeholder.substr(shown + 3, row.placeholder.size() - shown - 4);
  row.placeholder.resize(shown);
  return row;
}

/// "  -o [ --output ] FILE ..." is the first line of an option, "What to write:" the title of a group.
bool begins_with(const std::string& line, const po::option_description& option) {
  const std::string names = "  " + option.format_name();
  return line.starts_with(names) && (line.size() == names.size() || line[names.size()] == ' ');
}

}  // namespace

std::vector<OptionGroup> option_groups(const po::options_description& description) {
  std::ostringstream printed;  // Boost shows only here which group an option is in
  printed << description;
  std::istringstream lines(printed.str());
  std::vector<OptionGroup> groups;
  auto next = description.options().begin();
  for (std::string line; std::getline(lines, line) && next != description.options().end();) {
    if (!line.empty() && line.front() != ' ') groups.push_back({line.substr(0, line.size() - 1), {}});
    if (!begins_with(line, **next)) continue;
    if (groups.empty()) groups.emplace_back();
    groups.back().options.push_back(row_of(**next++));
  }
  return groups;
}

std::vector<OptionRow> option_rows(const po::options_description& description) {
  std::vector<OptionRow> rows;
  for (const auto& option : description.options()) rows.push_back(row_of(*option));
  return rows;
}

}  // namespace pbmpi::app
