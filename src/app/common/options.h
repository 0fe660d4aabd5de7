/// What the three programs' command lines have in common.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <boost/program_options.hpp>

#include "core/system/paths.h"

namespace pbmpi::app {

/// When a progress bar is drawn.
enum class ProgressMode { automatic, always, never };

struct CommonOptions {
  bool quiet = false;
  ProgressMode progress = ProgressMode::automatic;
};

/// --help, --version, --config, --quiet, --progress.
boost::program_options::options_description common_options_description();

/// Parses `args` (without the program's name) and, if given, the file named by --config. The command line
/// wins over it, and both over `last`, the options in a checkpoint, as lines of such a file.
/// `positional` names the option that takes the words without a dash; empty = such words are refused. Throws
/// core::InputError for anything that is not in `description`, with the nearest option, and for a file to be
/// written that another option also writes or reads.
boost::program_options::variables_map parse_command_line(
    const std::vector<std::string>& args, const boost::program_options::options_description& description,
    const boost::program_options::positional_options_description& positional = {},
    const std::string& last = "");

/// Opens a message about an option's value: with the file of --config, if the value comes from there and not
/// from `args`.
std::string place_of(const std::string& option, const std::vector<std::string>& args,
                     const boost::program_options::variables_map& values);

/// parse_command_line() for a command whose words without a dash are files to read: given_files().
boost::program_options::variables_map parse_with_files(
    const std::vector<std::string>& args, boost::program_options::options_description description);
/// The files given to parse_with_files(); empty if none is named.
std::vector<std::string> given_files(const boost::program_options::variables_map& values);

/// Adds --help and --quiet.
void add_help_options(boost::program_options::options_description& description);

/// Adds --seed, 1 by default; `meaning`: for --help.
void add_seed_option(const std::string& meaning, boost::program_options::options_description& description);
/// Throws core::InputError unless it is a whole number from 0 to 2^64 - 1.
std::uint64_t given_seed(const boost::program_options::variables_map& values);

/// The file to write that an option names, if given. Throws core::InputError for an empty name.
std::optional<std::string> output_path(const boost::program_options::variables_map& values,
                                       const char* option);

/// The files that a command line names: existing ones to be read, and those to be written. Excludes the
/// checkpoint to go on from, which the next one may replace.
std::vector<core::NamedPath> named_paths(const boost::program_options::variables_map& values);

/// Reads the common options out of a parsed command line. Throws core::InputError.
CommonOptions common_options(const boost::program_options::variables_map& values);

/// argv[1..] as strings.
std::vector<std::string> arguments(int argc, char** argv);

/// "pbmpi 0.1.0 (revision, compiler)".
std::string version_line(const std::string& program);

}  // namespace pbmpi::app
