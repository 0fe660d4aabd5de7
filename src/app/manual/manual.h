/// The text of --help of a program, or of one of its commands. Manual pages and completions are made from it.
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
  std::string name;        ///< "pbmpi", "pbreport csv"
  std::string about = {};  ///< a paragraph
  std::string usage = {};  ///< a command line
  std::string title = {};  ///< title of the list of commands
  std::vector<ManualEntry> commands = {};
  boost::program_options::options_description options;
  std::vector<std::string> basic = {};       ///< options that --help shows, in this order; empty: all
  std::vector<ManualEntry> exit_codes = {};  ///< empty for a command: its program's apply
  std::vector<std::string> notes = {};       ///< paragraphs
  std::vector<ManualEntry> files = {};       ///< what is read and written
  std::vector<std::string> examples = {};    ///< command lines
};

/// A command line without the word that may follow --help or -h.
struct HelpArguments {
  std::vector<std::string> args;
  bool all = false;  ///< "--help all" or "--help=all"
};

/// Throws core::InputError for another word after --help than all.
HelpArguments help_arguments(const std::vector<std::string>& args);

/// The text of --help. `args` say whether all is to be shown, or only the basic options, each in few words.
std::string help_of(const Manual& manual, const std::vector<std::string>& args = {});

/// Exit codes of programs that end early only for an error.
std::vector<ManualEntry> common_exit_codes();

}  // namespace pbmpi::app
