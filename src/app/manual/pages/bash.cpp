#include <sstream>

#include "app/manual/pages/completion.h"
#include "app/manual/pages/option_table.h"
#include "app/manual/pages/values.h"

namespace pbmpi::app {
namespace {

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// Prints lines like "  '':--output | '':-o) files=yes ;;"; `command` is the word that the options belong to.
void print_values(const std::string& command, const Manual& manual, std::ostream& out) {
  for (const OptionRow& option : option_rows(manual.options)) {
    if (option.placeholder.empty()) continue;
    out << "      " << command << ":--" << option.name;
    if (!option.short_name.empty()) out << " | " << command << ":-" << option.short_name;
    out << ") value=yes";
    const OfferedValues values = offered_values(option);
    if (option.takes_many) out << " many=yes";
    if (values.files) out << " action=file";
    if (values.folders) out << " action=directory";
    if (!values.words.empty()) out << " words='" << joined(values.words, " ") << "'";
    out << " ;;\n";
  }
}

void print_options(const std::string& command, const Manual& manual, std::ostream& out) {
  std::vector<std::string> words;
  for (const OptionRow& option : option_rows(manual.options)) {
    if (!option.short_name.empty()) words.push_back("-" + option.short_name);
    words.push_back("--" + option.name);
  }
  out << "    " << command << ") words='" << joined(words, " ") << "' ;;\n";
}

/// The words of a program's commands, e.g. for a pattern.
std::vector<std::string> command_words(const ProgramManual& program) {
  std::vector<std::string> words;
  for (const ManualEntry& command : program.program.commands) words.push_back(command.word);
  return words;
}

}  // namespace

std::string bash_completion(const ProgramManual& program) {
  const std::string name = program.program.name;
  const std::vector<std::string> commands = command_words(program);
  std::ostringstream out;
  out << "# bash completion for " << name << ", made from its options.\n"
      << "_" << name << "() {\n"
      << "  local word=${COMP_WORDS[COMP_CWORD]} command= option= value= many= words= action= i before=()\n"
      << "  for ((i = 1; i < COMP_CWORD; i++)); do  # --option=value is three words to bash\n"
      << "    [[ ${COMP_WORDS[i]} == = ]] || before+=(\"${COMP_WORDS[i]}\")\n"
      << "  done\n"
      << "  [[ $word != = ]] || word=\n";
  if (!program.commands.empty()) {
    out << "  case ${before[0]-} in\n";
    for (const Manual& command : program.commands)
      out << "    " << word_of(command) << ") command=" << word_of(command) << " ;;\n";
    out << "  esac\n";
  }
  out << "  for ((i = ${#before[@]} - 1; i >= 0; i--)); do\n"
      << "    [[ ${before[i]} != -* ]] || { option=${before[i]}; break; }\n"
      << "  done\n"
      << "  if [[ -n $option ]]; then\n"
      << "    case $command:$option in\n";
  print_values("", program.program, out);
  for (const Manual& command : program.commands) print_values(word_of(command), command, out);
  out << "    esac\n"
      << "  fi\n"
      << "  # Behind the value of an option that takes one, and where another option begins, no value "
         "follows.\n"
      << "  if [[ -n $value && (-n $many || i -eq ${#before[@]}-1) && ($word != -* || $words == +*) ]]; "
         "then\n"
      << "    mapfile -t COMPREPLY < <(compgen -W \"$words\" ${action:+-A \"$action\"} -- \"$word\")\n"
      << "    [[ -z $action ]] || compopt -o filenames 2>/dev/null\n"
      << "    return\n"
      << "  fi\n"
      << "  words= action=\n"
      << "  case $command in\n";
  print_options("''", program.program, out);
  for (const Manual& command : program.commands) print_options(word_of(command), command, out);
  out << "  esac\n";
  if (!commands.empty() || program.reads_files) {
    out << "  if [[ $word != -* ]]; then\n"
        << "    [[ ${#before[@]} -gt 0 ]] || words='" << joined(commands, " ") << "'\n";
    if (program.reads_files) {
      out << "    [[ ${#before[@]} -eq 0 ]] || words=\n"
          << "    action=file\n"
          << "    compopt -o filenames 2>/dev/null\n";
    }
    out << "  fi\n";
  }
  out << "  mapfile -t COMPREPLY < <(compgen -W \"$words\" ${action:+-A \"$action\"} -- \"$word\")\n"
      << "}\n"
      << "complete -F _" << name << " " << name << "\n";
  return out.str();
}

}  // namespace pbmpi::app
