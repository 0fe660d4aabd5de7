#include "app/pbmpi/options/options.h"

#include "app/pbmpi/options/run_options.h"
#include "core/error.h"
#include "engines/optional_engines.h"
#include "stepping/step_options.h"

namespace pbmpi::app {

namespace po = boost::program_options;
using core::require_input;

namespace {

po::options_description options_of(OptionGroup group, const char* heading) {
  po::options_description options(heading);
  if (group == OptionGroup::step) {
    for (const stepping::StepOption& option : stepping::step_options()) add_step_option(option, options);
  }
  add_run_options(group, options);
  return options;
}

po::options_description options_description() {
  po::options_description scene = options_of(OptionGroup::scene, "What to simulate");
  scene.add_options()("list-scenes", "list the scenes that pbmpi brings")  //
      ("describe",
       "print the resolved scene, the step plan, who owns what and the size of the file; run nothing");
  po::options_description step = options_of(OptionGroup::step, "How to step");
  step.add_options()("feec", po::value<std::string>()->implicit_value("", "")->value_name("[=SETTING]"),
                     "fast estimation with error control: estimate every frame by a short run from the "
                     "precise state before it is computed; the estimate goes to root at once, and is dropped "
                     "when the precise result is there. SETTING: what estimates, e.g. \"quick\", or \"sor "
                     "iterations=5 precision=single\"; default: that of --stepper, iterations=1");
  po::options_description all;
  all.add(scene)
      .add(step)
      .add(options_of(OptionGroup::cut, "How to cut the work"))
      .add(options_of(OptionGroup::output, "What to write"))
      .add(options_of(OptionGroup::stop, "When to stop, and how to go on"))
      .add(common_options_description());
  return all;
}

Action action_of(const po::variables_map& values) {
  if (values.count("help") != 0) return Action::help;
  if (values.count("version") != 0) return Action::version;
  if (values.count("list-scenes") != 0) return Action::list_scenes;
  return values.count("describe") != 0 ? Action::describe : Action::run;
}

constexpr const char* which_setting =
    "\n"
    "Which setting? The default, unless (docs/settings.md):\n"
    "  a frame must fit a budget   pbmpi --scene X --precision single, then --substeps 8\n"
    "  impacts must be right       pbmpi --scene X --approach 10cm\n"
    "  most things rest            pbmpi --scene X --tolerance 0.01mm\n"
    "  there are many worlds       mpirun -n RANKS pbmpi --scene X --replicas 1000 --precision single\n"
    "  one world is large          mpirun -n RANKS pbmpi --scene Battle2";

}  // namespace

Manual pbmpi_manual() {
  return {
      .name = "pbmpi",
      .about = "pbmpi simulates many rigid-body worlds over MPI ranks and shows what accuracy costs in time.",
      .usage = "mpirun -n RANKS pbmpi --scene NAME [options]",
      .options = options_description(),
      .basic = {"scene", "replicas", "frames", "stepper", "dt", "substeps", "iterations", "precision",
                "effects", "feec", "output", "record-every", "report", "resume", "config"},
      .exit_codes = {{"0", "done"},
                     {"1", "the simulation failed (what was written is readable)"},
                     {"2", "bad usage or bad input"},
                     {"75", "stopped early on request, with a checkpoint"}},
      .notes = {"Signals: INT, TERM and USR2 finish the frame, save the run, close the file and end with 75; "
                "USR1 saves it and the run goes on (send USR2 and USR1 to mpirun). Before the first frame "
                "INT and TERM end the run at once, and a second one always does; so does one whose frame "
                "goes on for 10 s, or three times the longest before.",
                "Steppers of other engines: " + engines::builds_text() + "."},
      .files = {{"SCENE.h5", "the run: poses, observables and times, in HDF5"},
                {"SCENE.xdmf", "the sidecar that opens it in ParaView"},
                {"SCENE.checkpoint.h5", "what --resume goes on from"}},
      .examples = {"mpirun -n 2 pbmpi --scene 100CrSk --report json", "pbmpi --scene CrashSk --describe"}};
}

Options parse_options(const std::vector<std::string>& args, const std::string& saved) {
  const po::variables_map values = parse_command_line(args, options_description(), {}, saved);
  Options options;
  options.action = action_of(values);
  options.command_line = "pbmpi";
  for (const std::string& arg : args) options.command_line += " " + arg;
  options.common = common_options(values);
  options.paths = named_paths(values);
  options.step = step_arguments(values);
  for (const RunOption& option : run_options()) {
    const std::string name(option.name);
    if (values.count(name) == 0 || values[name].defaulted()) continue;
    try {
      set(option, option.placeholder.empty() ? "" : values[name].as<std::string>(), options.run);
    } catch (const core::InputError& error) {
      throw core::InputError(place_of(name, args, values) + error.what());
    }
    options.given.insert(name);
  }
  if (values.count("feec") != 0) options.feec = values["feec"].as<std::string>();
  const bool needs_scene = options.action == Action::run || options.action == Action::describe;
  require_input(!needs_scene || options.run.scene || options.run.resume,
                std::string("no scene given; name one with --scene (see --list-scenes)\n") + which_setting);
  require_input(!(options.run.no_output && options.run.output),
                "--output and --no-output exclude each other; drop one");
  return options;
}

}  // namespace pbmpi::app
