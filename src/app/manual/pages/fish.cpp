#include <sstream>

#include "app/manual/pages/completion.h"
#include "app/manual/pages/option_table.h"
#include "app/manual/pages/values.h"

namespace pbmpi::app {
namespace {

/// In single quotes, as fish reads them.
std::string fish_quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') result += '\\';
    result += c;
  }
  return result + "'";
}

void print_fish_options(const std::string& begin, const Manual& manual, std::ostream& out) {
  for (const OptionRow& option : option_rows(manual.options)) {
    out << begin << " -l " << option.name;
    if (!option.short_name.empty()) out << " -s " << option.short_name;
    if (!option.placeholder.empty()) {
      const OfferedValues values = offered_values(option);
      std::string words = values.folders ? "(__fish_complete_directories)" : "";
      for (const std::string& word : values.words) words += (words.empty() ? "" : " ") + word;
      out << (values.files ? " -rF" : " -x");
      if (!words.empty()) out << " -a " << fish_quoted(words);
    }
    out << " -d " << fish_quoted(one_line(option.meaning, 70)) << "\n";
  }
}

}  // namespace

std::string fish_completion(const ProgramManual& program) {
  const std::string name = program.program.name;
  std::ostringstream out;
  out << "# fish completion for " << name << ", made from its options.\n";
  if (!program.reads_files) out << "complete -c " << name << " -f\n";
  std::string commands;
  for (const ManualEntry& command : program.program.commands) {
    out << "complete -c " << name << " -n __fish_use_subcommand -a " << command.word << " -d "
        << fish_quoted(command.meaning) << "\n";
  }
  for (const Manual& command : program.commands) commands += " " + word_of(command);
  const std::string own = commands.empty() ? "" : " -n 'not __fish_seen_subcommand_from" + commands + "'";
  print_fish_options("complete -c " + name + own, program.program, out);
  for (const Manual& command : program.commands) {
    print_fish_options("complete -c " + name + " -n '__fish_seen_subcommand_from " + word_of(command) + "'",
                       command, out);
  }
  return out.str();
}

}  // namespace pbmpi::app
