/// Command-line options that the reports of all studies share.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <boost/program_options.hpp>

#include "app/pbreport/tables/print_options.h"

namespace pbmpi::app {

struct ReportOfStudyOptions {
  bool help = false;
  std::string file;
  std::vector<std::string> scenes;  ///< empty: all in the file
  std::optional<std::string> html, csv;
  PrintForm form = PrintForm::text;
  bool quiet = false;
};

/// Adds --html and --csv. `page`: what the page shows.
void add_output_options(const std::string& page, boost::program_options::options_description& description);
/// Adds --scene.
void add_scene_choice(boost::program_options::options_description& description);

/// Throws core::InputError unless one file is named. `what`: e.g. "a study of effects", `example`: a file's
/// name. With --help nothing else is read.
ReportOfStudyOptions report_of_study_options(const boost::program_options::variables_map& values,
                                             const std::string& what, const std::string& example);

}  // namespace pbmpi::app
