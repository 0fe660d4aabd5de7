#include <sstream>

#include "app/manual/pages/completion.h"
#include "app/manual/pages/option_table.h"
#include "app/manual/pages/values.h"

namespace pbmpi::app {
namespace {

/// Text for _arguments, in single quotes: brackets and colons mean something to it.
std::string zsh_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
      continue;
    }
    if (c == '[' || c == ']' || c == ':' || c == '\\') result += '\\';
    result += c;
  }
  return result;
}

/// How _arguments completes a value.
std::string zsh_action(const OptionRow& option) {
  const OfferedValues values = offered_values(option);
  std::string words;
  for (const std::string& word : values.words) words += (words.empty() ? "" : " ") + word;
  if (!words.empty() && !values.files) return "(" + words + ")";
  // A colon ends the action, unless it is escaped.
  if (!words.empty()) return "{_alternative \"words\\:word\\:(" + words + ")\" \"files\\:file\\:_files\"}";
  if (values.folders) return "_files -/";
  return values.files ? "_files" : " ";
}

void print_zsh_options(const Manual& manual, std::ostream& out) {
  for (const OptionRow& option : option_rows(manual.options)) {
    std::string value;
    if (!option.placeholder.empty()) value = ":" + zsh_escaped(option.placeholder) + ":" + zsh_action(option);
    const std::string meaning = "[" + zsh_escaped(one_line(option.meaning, 70)) + "]" + value + "'";
    // An option with several values is offered again for each further one.
    out << " \\\n    '" << (option.takes_many ? "*" : "") << "--" << option.name << (value.empty() ? "" : "=")
        << meaning;
    if (!option.short_name.empty())
      out << " \\\n    '-" << option.short_name << (value.empty() ? "" : "+") << meaning;
  }
}

void print_arguments(const Manual& manual, bool reads_files, std::ostream& out) {
  out << "_arguments -s";
  print_zsh_options(manual, out);
  if (reads_files) out << " \\\n    '*:file:_files'";
  out << "\n";
}

}  // namespace

std::string zsh_completion(const ProgramManual& program) {
  std::ostringstream out;
  out << "#compdef " << program.program.name << "\n# zsh completion for " << program.program.name
      << ", made from its options.\n";
  if (program.commands.empty()) {
    print_arguments(program.program, program.reads_files, out);
    return out.str();
  }
  // The command's own options follow its word.
  out << "local -a commands=(";
  for (const ManualEntry& command : program.program.commands)
    out << "\n    '" << command.word << ":" << zsh_escaped(command.meaning) << "'";
  out << ")\n"
      << "if ((CURRENT == 2)) && [[ $words[2] != -* ]]; then\n"
      << "  _describe command commands\n"
      << (program.reads_files ? "  _files\n" : "") << "  return\n"
      << "fi\n"
      << "case $words[2] in\n";
  for (const Manual& command : program.commands) {
    out << "  " << word_of(command) << ")\n    shift words\n    ((CURRENT--))\n    ";
    print_arguments(command, program.reads_files, out);
    out << "    ;;\n";
  }
  out << "  *)\n    ";
  print_arguments(program.program, program.reads_files, out);
  out << "    ;;\nesac\n";
  return out.str();
}

}  // namespace pbmpi::app
