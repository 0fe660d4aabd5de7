/// What the command lines of reports have in common: what is printed, and the table that is written.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <boost/program_options.hpp>

namespace pbmpi::app {

enum class PrintForm { text, json, markdown };

/// --config and --quiet. `printed`: what --quiet lets through.
void add_general_options(const std::string& printed,
                         boost::program_options::options_description& description);
/// --json and --markdown. `markdown`: what the latter prints.
void add_print_options(const std::string& markdown, boost::program_options::options_description& description);
/// What they ask for. Throws core::InputError if it is both.
PrintForm print_form(const boost::program_options::variables_map& values);
/// --csv, and --table, by which one of `tables` is named for it.
void add_table_options(std::span<const std::string_view> tables, const std::string& usual,
                       boost::program_options::options_description& description);
/// Throws core::InputError unless it is one of `tables`.
std::string chosen_table(const boost::program_options::variables_map& values,
                         std::span<const std::string_view> tables);

}  // namespace pbmpi::app
