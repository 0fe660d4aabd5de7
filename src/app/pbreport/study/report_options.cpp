#include "app/pbreport/study/report_options.h"

#include "app/common/options.h"
#include "core/error.h"

namespace pbmpi::app {

namespace po = boost::program_options;
using core::require_input;

void add_output_options(const std::string& page, po::options_description& description) {
  description.add_options()                                                                                //
      ("html", po::value<std::string>()->value_name("OUT"), ("one self-contained page: " + page).c_str())  //
      ("csv", po::value<std::string>()->value_name("OUT"), "all cases as comma-separated values");
}

void add_scene_choice(po::options_description& description) {
  description.add_options()("scene",
                            po::value<std::vector<std::string>>()->multitoken()->value_name("NAME..."),
                            "these scenes of the study only");
}

ReportOfStudyOptions report_of_study_options(const po::variables_map& values, const std::string& what,
                                             const std::string& example) {
  ReportOfStudyOptions options;
  options.help = values.count("help") != 0;
  if (options.help) return options;
  if (values.count("scene") != 0) options.scenes = values["scene"].as<std::vector<std::string>>();
  options.html = output_path(values, "html");
  options.csv = output_path(values, "csv");
  options.form = print_form(values);
  options.quiet = values.count("quiet") != 0;
  require_input(values.count("file") != 0,
                "no file given; name the file of " + what + ", e.g. pbreport " + example);
  const auto files = given_files(values);
  require_input(files.size() == 1, "'" + files.back() + "' follows '" + files.front() + "': give one study");
  options.file = files.front();
  return options;
}

}  // namespace pbmpi::app
