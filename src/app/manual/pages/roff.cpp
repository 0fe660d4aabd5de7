#include "app/manual/pages/roff.h"

#include <algorithm>
#include <cctype>
#include <sstream>

#include "app/common/version.h"
#include "app/manual/pages/option_table.h"

namespace pbmpi::app {
namespace {

/// Text taken literally: no letter means anything to roff.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else if (c == '\'') {
      result += "\\(aq";
    } else if (c == '"') {
      result += "\\(dq";
    } else {
      result += c;
    }
  }
  return !result.empty() && result.front() == '.' ? "\\&" + result : result;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string section(const std::string& title) { return ".SH " + title + "\n"; }
std::string paragraph(const std::string& text) { return ".PP\n" + escaped(text) + "\n"; }

/// Words and what they mean.
std::string list_of_entries(const std::vector<ManualEntry>& entries) {
  std::string text;
  for (const ManualEntry& entry : entries)
    text += ".TP\n" + bold(entry.word) + "\n" + escaped(entry.meaning) + "\n";
  return text;
}

std::string option_text(const OptionRow& option) {
  std::string text = ".TP\n";
  if (!option.short_name.empty()) text += bold("-" + option.short_name) + ", ";
  text += bold("--" + option.name);
  if (!option.placeholder.empty()) text += " " + italic(option.placeholder);
  text += "\n" + escaped(option.meaning);
  if (!option.fallback.empty()) text += escaped(" [" + option.fallback + "]");
  return text + "\n";
}

std::string options_text(const Manual& manual) {
  std::string text = section("OPTIONS");
  text += paragraph("What stands in brackets is the default.");
  for (const OptionGroup& group : option_groups(manual.options)) {
    if (group.title != "Options") text += ".SS \"" + escaped(group.title) + "\"\n";
    for (const OptionRow& option : group.options) text += option_text(option);
  }
  return text;
}

/// Lines set literally.
std::string verbatim(const std::vector<std::string>& lines) {
  std::string text = ".PP\n.RS 4\n.nf\n";
  for (const std::string& line : lines) text += escaped(line) + "\n";
  return text + ".fi\n.RE\n";
}

std::string see_also(const Manual& manual, const ProgramManual& of) {
  std::vector<std::string> names = {"pbmpi", "pbstudy", "pbreport"};
  if (manual.name == of.program.name) {
    for (const Manual& command : of.commands) names.push_back(page_name(command));
  }
  std::erase(names, manual.name);
  std::string text = ".PP\n";
  for (const std::string& name : names) text += (name == names.front() ? "" : ",\n") + bold(name) + "(1)";
  return section("SEE ALSO") + text + "\n.PP\nThe pages in share/doc/pbmpi of the installation.\n";
}

}  // namespace

std::string roff_page(const Manual& manual, const ProgramManual& of) {
  const std::string name = page_name(manual);
  std::string capitals = name;
  std::ranges::transform(capitals, capitals.begin(), [](unsigned char c) { return std::toupper(c); });
  std::ostringstream text;
  text << ".TH \"" << escaped(capitals) << "\" 1 \"\" \"pbmpi " << program_version << "\" \"User Commands\"\n"
       << section("NAME") << escaped(name) << " \\- " << escaped(manual.meaning) << "\n"
       << section("SYNOPSIS") << verbatim({manual.usage})  //
       << section("DESCRIPTION") << paragraph(manual.about);
  if (!manual.commands.empty()) {
    text << ".SS \"" << escaped(manual.title.substr(0, manual.title.find(" ("))) << "\"\n"
         << list_of_entries(manual.commands);
  }
  text << options_text(manual);
  if (!manual.notes.empty()) text << section("NOTES");
  for (const std::string& note : manual.notes) text << paragraph(note);
  text << section("\"EXIT STATUS\"")
       << list_of_entries(manual.exit_codes.empty() ? of.program.exit_codes : manual.exit_codes);
  if (!manual.files.empty()) text << section("FILES") << list_of_entries(manual.files);
  if (!manual.examples.empty()) text << section("EXAMPLES") << verbatim(manual.examples);
  text << see_also(manual, of);
  return text.str();
}

}  // namespace pbmpi::app
