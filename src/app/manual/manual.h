/// The text of --help and of the manual page of a program, or of one of its commands: both are made from it.
#pragma once

#include <string>
#include <vector>

#include <boost/program_options.hpp>

namespace pbmpi::app {

/// A word and what it means: a command, a file, an exit code.
struct ManualEntry {
  std::string word;
  std::string meaning;
};

struct Manual {
  std::string name;          ///< "pbmpi", "pbreport csv"
  std::string meaning = {};  ///< one line; for a command, its line in the program's list
  std::string about = {};    ///< a paragraph
  std::string usage = {};    ///< a command line
  std::string title = {};    ///< title of the list of commands, as in --help
  std::vector<ManualEntry> commands = {};
  boost::program_options::options_description options;
  std::vector<ManualEntry> exit_codes = {};  ///< empty for a command: its program's apply
  std::vector<std::string> notes = {};       ///< paragraphs
  std::vector<ManualEntry> files = {};       ///< what is read and written; for the page only
  std::vector<std::string> examples = {};    ///< command lines
};

/// The text of --help.
std::string help_of(const Manual& manual);

/// Exit codes of programs that end early only for an error.
std::vector<ManualEntry> common_exit_codes();

}  // namespace pbmpi::app
