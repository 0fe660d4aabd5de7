/// Command-line options that reports share: what is printed, and the table that is written.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <boost/program_options.hpp>

namespace pbmpi::app {

enum class PrintForm { text, json, markdown };

/// Adds --config and --quiet. `printed`: what is printed despite --quiet.
void add_general_options(const std::string& printed,
                         boost::program_options::options_description& description);
/// Adds --json and --markdown. `markdown`: what the latter prints.
void add_print_options(const std::string& markdown, boost::program_options::options_description& description);
/// The form that --json and --markdown ask for. Throws core::InputError if both are given.
PrintForm print_form(const boost::program_options::variables_map& values);
/// Adds --csv, and --table, which names one of `tables` for it.
void add_table_options(std::span<const std::string_view> tables, const std::string& usual,
                       boost::program_options::options_description& description);
/// The table named by --table. Throws core::InputError unless it is one of `tables`.
std::string chosen_table(const boost::program_options::variables_map& values,
                         std::span<const std::string_view> tables);

}  // namespace pbmpi::app
