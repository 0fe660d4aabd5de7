/// What --help and the manual page say of a program, or of one of its commands: both are made from it.
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
  std::string meaning = {};  ///< one line; of a command that of the program's list
  std::string about = {};    ///< a paragraph
  std::string usage = {};    ///< a command line
  std::string title = {};    ///< of the commands, as in --help
  std::vector<ManualEntry> commands = {};
  boost::program_options::options_description options;
  std::vector<ManualEntry> exit_codes = {};  ///< of a command: none, they are its program's
  std::vector<std::string> notes = {};       ///< paragraphs
  std::vector<ManualEntry> files = {};       ///< what is read and left; for the page only
  std::vector<std::string> examples = {};    ///< command lines
};

/// The text of --help.
std::string help_of(const Manual& manual);

/// Those of programs that end early for no other reason than an error.
std::vector<ManualEntry> common_exit_codes();

}  // namespace pbmpi::app
