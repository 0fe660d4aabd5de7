#include "app/pbreport/engines/engines_options.h"

#include "app/common/options.h"
#include "app/pbreport/engines/engines.h"
#include "app/pbreport/study/report_options.h"
#include "app/pbreport/study/study_file.h"
#include "core/error.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using core::require_input;

po::options_description visible_options() {
  po::options_description all("Options");
  add_scene_choice(all);
  all.add_options()("html", po::value<std::string>()->value_name("OUT"),
                    "one self-contained page: fronts of all engines in one diagram a scene, and the tables");
  add_print_options("print the tables in Markdown", all);
  add_general_options("--json or --markdown", all);
  return all;
}

}  // namespace

Manual engines_manual() {
  return {
      .name = "pbreport engines",
      .about =
          "pbreport engines shows engines side by side: of pbstudy accuracy each engine's front of error "
          "against time, by the common reference and by its own solution, and its noise; of pbstudy "
          "stability what each setting holds; and what each engine cannot express. Either file may be left "
          "out.",
      .usage = "pbreport engines [accuracy.h5] [stability.h5] [options]",
      .options = visible_options(),
      .examples = {"pbstudy accuracy --scene CrashWa --stepper quick direct sor bullet mujoco",
                   "pbstudy stability --setting quick direct sor bullet mujoco",
                   "pbreport engines accuracy.h5 stability.h5 --html engines.html"}};
}

EnginesOptions parse_engines_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_with_files(args, visible_options());
  EnginesOptions options;
  options.help = values.count("help") != 0;
  if (options.help) return options;
  for (const std::string& file : given_files(values)) {
    const std::string kind = study_named_in({file});
    require_input(kind == "accuracy" || kind == "stability",
                  file + ": engines are compared by studies of accuracy and stability; this is " +
                      (kind.empty() ? "no study" : "a study of " + kind));
    std::optional<std::string>& place = kind == "accuracy" ? options.accuracy : options.stability;
    require_input(!place, "'" + file + "' follows '" + place.value_or("") + "': give one study of " + kind);
    place = file;
  }
  require_input(
      options.accuracy || options.stability,
      "no file given; name one of pbstudy accuracy, one of pbstudy stability, or both, e.g. pbreport "
      "engines accuracy.h5 stability.h5");
  if (values.count("scene") != 0) options.scenes = values["scene"].as<std::vector<std::string>>();
  require_input(options.scenes.empty() || options.accuracy,
                "--scene chooses scenes of a study of accuracy; name one");
  options.html = output_path(values, "html");
  options.form = print_form(values);
  options.quiet = values.count("quiet") != 0;
  return options;
}

}  // namespace pbmpi::app
