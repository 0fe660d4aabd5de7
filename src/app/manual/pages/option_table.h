/// The options of a program as rows, from Boost's description of them.
#pragma once

#include <string>
#include <vector>

#include <boost/program_options.hpp>

namespace pbmpi::app {

struct OptionRow {
  std::string name;         ///< "output", without dashes
  std::string short_name;   ///< "o", or empty
  std::string placeholder;  ///< "FILE"; empty: the option takes no value
  std::string fallback;     ///< the default that Boost shows, or empty
  std::string meaning;
  bool takes_many = false;  ///< several values, up to the next option
};

struct OptionGroup {
  std::string title;
  std::vector<OptionRow> options;
};

/// In the order of --help.
std::vector<OptionGroup> option_groups(const boost::program_options::options_description& description);
/// The rows of all groups.
std::vector<OptionRow> option_rows(const boost::program_options::options_description& description);

}  // namespace pbmpi::app
