#include "app/pbreport/effects/effects_options.h"

#include <sstream>

#include "app/common/options.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using core::require_input;

po::options_description visible_options() {
  po::options_description all("Options");
  all.add_options()  //
      ("scene", po::value<std::vector<std::string>>()->multitoken()->value_name("NAME..."),
       "these scenes of the study only")  //
      ("html", po::value<std::string>()->value_name("OUT"),
       "one self-contained page: share of the step and error if left out, effect by scene")        //
      ("csv", po::value<std::string>()->value_name("OUT"), "all cases as comma-separated values")  //
      ("json", "print all as one JSON document")                                                   //
      ("markdown",
       "print a table a stepper instead: share of the step [%] and defect without the effect, in "
       "brackets what demanding it costs")  //
      ("help,h", "print this help")         //
      ("config", po::value<std::string>()->value_name("FILE"),
       "read options from FILE, one 'name = value' a line; the command line wins")  //
      ("quiet,q", "print nothing but errors and what --json or --markdown asks for");
  return all;
}

}  // namespace

std::string effects_report_help_text() {
  std::ostringstream text;
  text << "pbreport effects shows what each effect costs: the file of pbstudy effects. The word effects may "
          "be left out.\n\n"
       << "Usage: pbreport [effects] effects.h5 [options]\n\n"
       << visible_options();
  return text.str();
}

EffectsReportOptions parse_effects_report_options(const std::vector<std::string>& args) {
  po::options_description all = visible_options();
  all.add_options()("file", po::value<std::vector<std::string>>());
  po::positional_options_description positional;
  positional.add("file", -1);
  const po::variables_map values = parse_command_line(args, all, positional);
  EffectsReportOptions options;
  options.help = values.count("help") != 0;
  if (options.help) return options;
  if (values.count("scene") != 0) options.scenes = values["scene"].as<std::vector<std::string>>();
  options.html = output_path(values, "html");
  options.csv = output_path(values, "csv");
  options.json = values.count("json") != 0;
  options.markdown = values.count("markdown") != 0;
  require_input(!options.json || !options.markdown, "--json and --markdown: print one of the two");
  options.quiet = values.count("quiet") != 0;
  require_input(values.count("file") != 0,
                "no file given; name the file of a study of effects, e.g. pbreport effects.h5");
  const auto files = values["file"].as<std::vector<std::string>>();
  require_input(files.size() == 1, "'" + files.back() + "' follows '" + files.front() + "': give one study");
  options.file = files.front();
  for (const auto& output : {options.html, options.csv}) {
    require_input(output != options.file, options.file + ": this file is to be read, not written over");
  }
  return options;
}

}  // namespace pbmpi::app
