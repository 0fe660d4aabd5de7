#include "app/manual/manual.h"

#include <algorithm>
#include <sstream>

namespace pbmpi::app {
namespace {

/// The paragraph in lines as long as those of the options.
std::string wrapped(const std::string& paragraph) {
  std::istringstream words(paragraph);
  std::string text, line;
  for (std::string word; words >> word;) {
    if (!line.empty() &&
        line.size() + 1 + word.size() > boost::program_options::options_description::m_default_line_length) {
      text += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + line + "\n";
}

std::string table_of(const std::vector<ManualEntry>& entries) {
  std::size_t width = 0;
  for (const ManualEntry& entry : entries) width = std::max(width, entry.word.size());
  std::string text;
  for (const ManualEntry& entry : entries)
    text += "  " + entry.word + std::string(width + 2 - entry.word.size(), ' ') + entry.meaning + "\n";
  return text;
}

std::string exit_codes_of(const Manual& manual) {
  std::string text;
  for (const ManualEntry& code : manual.exit_codes)
    text += (text.empty() ? "Exit codes: " : "; ") + code.word + " " + code.meaning;
  return text.empty() ? text : "\n" + wrapped(text + ".");
}

}  // namespace

std::string help_of(const Manual& manual) {
  std::ostringstream text;
  text << wrapped(manual.about) << "\nUsage: " << manual.usage << "\n\n";
  if (!manual.commands.empty()) text << manual.title << ":\n" << table_of(manual.commands) << "\n";
  text << manual.options << exit_codes_of(manual);
  for (const std::string& note : manual.notes) text << "\n" << wrapped(note);
  if (!manual.examples.empty()) text << "\nExamples:\n";
  for (const std::string& example : manual.examples) text << "  " << example << "\n";
  return text.str();
}

std::vector<ManualEntry> common_exit_codes() {
  return {{"0", "done"}, {"1", "failed"}, {"2", "bad usage or bad input"}};
}

}  // namespace pbmpi::app
