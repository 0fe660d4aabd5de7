#include "app/manual/manual.h"

#include <algorithm>
#include <regex>
#include <sstream>

#include "core/error.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

constexpr std::size_t line_length = 80;  // Boost's, for options
/// Where the meanings of basic options begin, and how many letters of each are shown at most.
constexpr std::size_t meaning_column = 28, meaning_length = 2 * (line_length - meaning_column);

/// The paragraph in lines that begin at `column`.
std::string wrapped(const std::string& paragraph, std::size_t column = 0) {
  std::istringstream words(paragraph);
  std::string text, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && column + line.size() + 1 + word.size() > line_length) {
      text += line + "\n" + std::string(column, ' ');
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + line + "\n";
}

std::string table_of(const std::string& title, const std::vector<ManualEntry>& entries) {
  if (entries.empty()) return {};
  std::size_t width = 0;
  for (const ManualEntry& entry : entries) width = std::max(width, entry.word.size());
  std::string text = title + ":\n";
  for (const ManualEntry& entry : entries)
    text += "  " + entry.word + std::string(width + 2 - entry.word.size(), ' ') + entry.meaning + "\n";
  return text + "\n";
}

std::string exit_codes_of(const Manual& manual) {
  std::string text;
  for (const ManualEntry& code : manual.exit_codes)
    text += (text.empty() ? "Exit codes: " : "; ") + code.word + " " + code.meaning;
  return text.empty() ? text : wrapped(text + ".") + "\n";
}

std::string examples_of(const Manual& manual) {
  std::string text = manual.examples.empty() ? "" : "Examples:\n";
  for (const std::string& example : manual.examples) text += "  $ " + example + "\n";  // help2man's mark
  return text;
}

/// "-o, --output FILE" where Boost prints "-o [ --output ] FILE", "--feec[=SETTING]" without a blank between,
/// and two blanks before the meaning where it prints one after a long default: what help2man and completions
/// read.
std::string in_usual_form(const std::string& printed) {
  static const std::regex both_names(R"((-\w) \[ (--[\w-]+) \]((?: \S+)*))");
  static const std::regex one_blank(R"(( \(=\S+\)) (?=\S))");
  static const std::regex joined_value(R"((--[\w-]+) (\[=\S+\]))");
  const std::string text = std::regex_replace(printed, both_names, "$1, $2$3   ");
  return std::regex_replace(std::regex_replace(text, one_blank, "$1  "), joined_value, "$1$2 ");
}

std::string all_options(const Manual& manual) {
  std::ostringstream printed;
  printed << manual.options;
  const std::string text = in_usual_form(printed.str());
  return "Options:\n" + (text.starts_with("Options:\n") ? text.substr(text.find('\n') + 1) : text);
}

/// The meaning if it is short, else its first clause.
std::string in_few_words(const std::string& meaning) {
  if (meaning.size() <= meaning_length) return meaning;
  std::size_t end = meaning.size();
  for (const char* stop : {"; ", ": ", ". "}) end = std::min(end, meaning.find(stop, meaning_length / 4));
  return meaning.substr(0, end);
}

std::string basic_options(const Manual& manual) {
  std::string text = "Options (" + manual.name + " --help all shows all " +
                     std::to_string(manual.options.options().size()) + "):\n";
  for (const std::string& name : manual.basic) {
    const po::option_description& option = manual.options.find(name, false);
    std::string names = in_usual_form("  " + option.format_name() + " " + option.format_parameter());
    names.resize(names.find_last_not_of(' ') + 1);
    if (names.size() + 1 < meaning_column) {
      names.resize(meaning_column, ' ');
    } else {
      names += "\n" + std::string(meaning_column, ' ');
    }
    text += names + wrapped(in_few_words(option.description()), meaning_column);
  }
  return text;
}

}  // namespace

HelpArguments help_arguments(const std::vector<std::string>& args) {
  static const std::string joined = "--help=";
  HelpArguments result;
  for (std::size_t i = 0; i < args.size(); ++i) {
    const bool is_joined = args[i].starts_with(joined);
    result.args.push_back(is_joined ? "--help" : args[i]);
    if (result.args.back() != "--help" && args[i] != "-h") continue;
    const bool follows = !is_joined && i + 1 < args.size() && !args[i + 1].starts_with("-");
    if (!is_joined && !follows) continue;
    const std::string word = is_joined ? args[i].substr(joined.size()) : args[++i];
    core::require_input(word == "all",
                        "--help " + word + ": write --help for the basic options, or --help all for all");
    result.all = true;
  }
  return result;
}

std::string help_of(const Manual& manual, const std::vector<std::string>& args) {
  std::string text = wrapped(manual.about) + "\nUsage: " + manual.usage + "\n\n";
  text += table_of(manual.title, manual.commands);
  if (!manual.basic.empty() && !help_arguments(args).all)
    return text + basic_options(manual) + "\n" + exit_codes_of(manual) + examples_of(manual);
  // Ahead of the options, as help2man takes what follows them for a part of theirs.
  text += exit_codes_of(manual);
  for (const std::string& note : manual.notes) text += wrapped(note) + "\n";
  return text + all_options(manual) + "\n" + table_of("Files", manual.files) + examples_of(manual);
}

std::vector<ManualEntry> common_exit_codes() {
  return {{"0", "done"}, {"1", "failed"}, {"2", "bad usage or bad input"}};
}

}  // namespace pbmpi::app
