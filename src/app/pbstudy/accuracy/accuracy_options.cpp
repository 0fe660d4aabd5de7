#include "app/pbstudy/accuracy/accuracy_options.h"

#include <cmath>
#include <sstream>

#include "app/pbstudy/study/option_lists.h"
#include "core/error.h"
#include "stepping/names.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;
using core::require_input;

po::options_description options_description() {
  po::options_description what("What to vary (lists, separated by blanks; all are crossed)");
  add_scene_option(what);
  what.add_options()                                                                 //
      ("stepper", list_of<std::string>(), "quick, direct, sor; default: quick sor")  //
      ("iterations", list_of<int>(), "default: 1 2 3 5 10 15 19 20 40 80")           //
      ("substeps", list_of<int>(), "sor; default: 1 2 4 8 16")                       //
      ("precision", list_of<std::string>(), "sor: double, single; default: both")    //
      ("sor-factor", list_of<double>(), "sor: over-relaxation; default: 1.3")        //
      ("warm-start", list_of<double>(),
       "sor, with several substeps: share of the impulses that a substep takes over; default: 0 0.9")  //
      ("row-order", list_of<std::string>(),
       "sor: shuffled (anew every 8 iterations), fixed; default: shuffled")  //
      ("estimates", list_of<int>(),
       "sor: FEEC cases, not crossed with the others: the state after so many iterations of a frame's last "
       "solve, which has the scene's iterations; 0: none; default: 1 5")                                  //
      ("dt", list_of<double>(), "step [s], a whole number of which fills a frame; default: the scene's")  //
      ("max-sweeps", po::value<int>()->default_value(320)->value_name("N"),
       "leave out cases with more iterations x substeps");
  po::options_description how =
      how_to_measure({"of the scene's variation and of the reference's row order",
                      "how often each frame is timed, the process being alone on its core", 5,
                      "noise floor: the reference with this many other solver seeds", 8});
  how.add_options()  //
      ("reference-iterations", po::value<int>()->default_value(640)->value_name("N"),
       "the reference is sor in double precision with these iterations, so that it solves the scene's own "
       "step; "
       "checked by halving")  //
      ("reference-substeps", po::value<int>()->default_value(1)->value_name("N"),
       "... in each of these substeps; checked by halving. More than 1 only for scenes without fast impacts");
  po::options_description all;
  all.add(what).add(how).add(what_to_write("accuracy.h5")).add(common_options_description());
  return all;
}

void require_possible(const AccuracyOptions& options) {
  require_at_least(options.iterations, 1, "--iterations");
  require_at_least(options.substeps, 1, "--substeps");
  require_at_least({options.max_sweeps}, 1, "--max-sweeps");
  require_at_least({options.reference_iterations}, 2, "--reference-iterations");
  require_at_least({options.reference_substeps}, 1, "--reference-substeps");
  for (const double factor : options.sor_factors) {
    require_input(factor > 0 && factor < 2, "--sor-factor " + std::to_string(factor) +
                                                ": the iteration converges above 0 and below 2 only");
  }
  for (const double share : options.warm_starts) {
    require_input(share >= 0 && share <= 1, "--warm-start " + std::to_string(share) +
                                                ": the share of the impulses to take over is 0 to 1");
  }
  require_at_least(options.estimates, 0, "--estimates");
  for (const double dt_s : options.dts_s) {
    require_input(std::isfinite(dt_s) && dt_s > 0,
                  "--dt " + std::to_string(dt_s) + " s: a step must be finite and above 0");
  }
}

}  // namespace

std::string accuracy_help_text() {
  std::ostringstream text;
  text << "pbstudy accuracy measures what accuracy costs in time. Each case is a world of its own (with its "
          "scene's "
          "replicas) and a setting. Its defect is the error after one frame from the reference's own state, "
          "anew in "
          "every measured frame; its drift is the error along the trajectory from the start.\n\n"
       << "Usage: mpirun -n RANKS pbstudy accuracy [--scene NAME...] [options]\n\n"
       << options_description()
       << "\nThe cases are dealt out over the ranks; a rank works on one at a time. More ranks than cores "
          "spoil the "
          "times.\nThen: pbreport accuracy.h5 --budget 3.33ms --html accuracy.html\n";
  return text.str();
}

AccuracyOptions parse_accuracy_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_command_line(args, options_description());
  AccuracyOptions options;
  static_cast<StudyOptions&>(options) = study_options(values, "pbstudy accuracy", args);
  options.steppers =
      choices<stepping::StepperKind>(values, "stepper", stepping::stepper_kind_names, {"quick", "sor"});
  options.iterations = list<int>(values, "iterations", {1, 2, 3, 5, 10, 15, 19, 20, 40, 80});
  options.substeps = list<int>(values, "substeps", {1, 2, 4, 8, 16});
  options.precisions =
      choices<stepping::Precision>(values, "precision", stepping::precision_names, {"double", "single"});
  options.sor_factors = list<double>(values, "sor-factor", {1.3});
  options.warm_starts = list<double>(values, "warm-start", {0, 0.9});
  options.row_orders =
      choices<stepping::RowOrder>(values, "row-order", stepping::row_order_names, {"shuffled"});
  options.estimates = list<int>(values, "estimates", {1, 5});
  options.dts_s = list<double>(values, "dt", {});
  options.max_sweeps = values["max-sweeps"].as<int>();
  options.reference_iterations = values["reference-iterations"].as<int>();
  options.reference_substeps = values["reference-substeps"].as<int>();
  require_possible(options);
  return options;
}

}  // namespace pbmpi::app
