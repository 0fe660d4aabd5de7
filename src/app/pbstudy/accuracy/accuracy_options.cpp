#include "app/pbstudy/accuracy/accuracy_options.h"

#include <array>

#include "core/quantity.h"

namespace pbmpi::app {
namespace {

namespace po = boost::program_options;

/// In the order in which cases are crossed, the last varying fastest.
constexpr std::array<VariedOption, 7> varied = {{
    {"stepper", "quick, direct, sor, bullet, mujoco; default: quick sor", "quick sor"},
    {"law", "sor: ode, soft, coulomb; default: ode soft", "ode soft"},
    {"iterations", "but of --law soft, which takes 1; default: 1 5 20 80", "1 5 20 80"},
    {"substeps", "sor; default: 1 2 4 7 14", "1 2 4 7 14"},
    {"precision", "sor: double, single; default: both", "double single"},
    {"tolerance", "soft law: below how long a way an island gets one substep; default: 0", "0"},
    {"approach", "soft law: how far bodies may approach in a step before it is cut; default: 10cm; 0: any",
     "10cm"},
}};
constexpr VariedOption varied_dt = {
    "dt",
    "step, e.g. 5ms, a whole number of which fills a frame; default: the scene's, "
    "a half, a quarter and an eighth of it",
    ""};

po::options_description options_description() {
  po::options_description what("What to vary (lists, separated by blanks; all are crossed)");
  add_scene_option(what);
  for (const VariedOption& one : varied) add_setting_list(one, what);
  what.add_options()  //
      ("estimates", list_of<int>(),
       "FEEC cases, not crossed with the others, at the first step of --dt: frames of each stepper and law "
       "as "
       "they are by default, estimated with so many iterations; 0: none; default: 1 5");
  add_setting_list(varied_dt, what);
  what.add_options()  //
      ("max-sweeps", po::value<int>()->default_value(80)->value_name("N"),
       "leave out cases with more iterations x substeps")  //
      ("rest-seconds", po::value<std::string>()->default_value("3s")->value_name("TIME"),
       "time for which the scene at rest is watched under each setting: what falls, creeps or gains energy; "
       "0: none");
  po::options_description how =
      how_to_measure({"of the scene's variation and of the solver's row order",
                      "how often each frame is timed, the process being alone on its core", 5,
                      "noise floor of each engine: its own solution with this many other solver seeds", 2});
  how.add_options()  //
      ("nature-steps", po::value<int>()->default_value(1536)->value_name("N"),
       "nature is the limit of ever shorter steps, reached in two ways: by springs as stiff as a step bears, "
       "and by ODE's rows with cones of friction, each begun with the scene's own step; so many steps a "
       "frame "
       "at most")  //
      ("nature-error", po::value<std::string>()->default_value("0.1mm")->value_name("LENGTH"),
       "... or until half the step moves nine tenths of the bodies by less; 0: always the most steps")  //
      ("own-iterations", po::value<int>()->default_value(640)->value_name("N"),
       "compare each setting with the first step of --dt also with its own equations, solved by its own "
       "stepper: each frame is tried "
       "with N "
       "iterations a step first, then with four times as many again and again until no body ends farther "
       "than 0.01 mm from where it did before; and that with itself from disturbed states, as often as "
       "--floor-seeds says; 0: neither")  //
      ("own-most-iterations", po::value<int>()->default_value(10240)->value_name("N"),
       "... or so many are done");
  po::options_description all;
  all.add(what).add(how).add(what_to_write("accuracy.h5")).add(common_options_description());
  return all;
}

void require_possible(const AccuracyOptions& options) {
  require_at_least({options.max_sweeps}, 1, "--max-sweeps");
  require_at_least({options.nature.most_steps}, 2, "--nature-steps");
  require_at_least({options.own_iterations}, 0, "--own-iterations");
  require_at_least({options.own_most_iterations}, 4 * options.own_iterations, "--own-most-iterations");
  require_at_least(options.estimates, 0, "--estimates");
}

}  // namespace

Manual accuracy_manual() {
  return {.name = "pbstudy accuracy",
          .about =
              "pbstudy accuracy measures what accuracy costs in time. Each case is a world of its own (with "
              "its scene's replicas) and a setting. Its defect is the error after one frame from a state of "
              "nature, anew in every measured frame: the distance from where ever shorter steps lead, of the "
              "bodies for which two independent ways agree on that. Its drift is the error along the "
              "trajectory from the start. Its own defect is the distance from its own equations, solved by "
              "many iterations of its own stepper.",
          .usage = "mpirun -n RANKS pbstudy accuracy [--scene NAME...] [options]",
          .options = options_description(),
          .basic = {"scene", "stepper", "iterations", "substeps", "precision", "dt", "estimates", "replicas",
                    "frames", "repeats", "floor-seeds", "output", "max-time", "resume"},
          .notes = {std::string(one_case_a_rank) + spoils_times},
          .examples = {"mpirun -n 2 pbstudy accuracy --scene CrashWa",
                       "pbreport accuracy.h5 --budget 3.33ms --html accuracy.html"}};
}

AccuracyOptions parse_accuracy_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_command_line(args, options_description());
  AccuracyOptions options;
  static_cast<StudyOptions&>(options) = study_options(values, "pbstudy accuracy", args);
  options.settings = setting_lists(varied, values);
  options.dts = setting_list(varied_dt, values);
  options.estimates = list<int>(values, "estimates", {1, 5});
  options.max_sweeps = values["max-sweeps"].as<int>();
  options.nature.most_steps = values["nature-steps"].as<int>();
  options.nature.error_m =
      core::read_quantity(values["nature-error"].as<std::string>(), "--nature-error", core::length_with_unit);
  options.nature.seed = options.seed;
  options.own_iterations = values["own-iterations"].as<int>();
  options.own_most_iterations = values["own-most-iterations"].as<int>();
  options.rest_s =
      core::read_quantity(values["rest-seconds"].as<std::string>(), "--rest-seconds", core::run_time_or_none);
  require_possible(options);
  return options;
}

}  // namespace pbmpi::app
