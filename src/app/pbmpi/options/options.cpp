#include "app/pbmpi/options/options.h"

#include <array>
#include <cmath>
#include <string_view>

#include "app/common/quantities.h"
#include "core/error.h"
#include "effects/effect_choices.h"
#include "effects/effects.h"
#include "engines/optional_engines.h"
#include "model/names.h"
#include "stepping/step_options.h"

namespace pbmpi::app {

namespace po = boost::program_options;
using core::require_input;

namespace {

std::string effect_list() {
  std::string list;
  for (const effects::Effect& effect : effects::effect_registry())
    list += (list.empty() ? "" : ", ") + std::string(effect.name);
  return list;
}

po::options_description options_description() {
  po::options_description what("What to simulate");
  what.add_options()  //
      ("scene", po::value<std::string>()->value_name("NAME|FILE"),
       "a scene that pbmpi brings (--list-scenes), or a file of your own: a scene (.toml), or a model in "
       "MJCF "
       "(.xml) or URDF (.urdf)")                            //
      ("list-scenes", "list the scenes that pbmpi brings")  //
      ("describe",
       "print the resolved scene, the step plan, who owns what and the size of the file; run nothing")  //
      ("replicas", po::value<int>()->value_name("N"), "worlds; default: the scene's")                   //
      ("parameters", po::value<std::string>()->value_name("FILE"),
       "what each world has otherwise than the scene: a table with a world a row and a column a parameter, "
       "car.speed or world.gravity (scenes/FORMAT.md); CSV, or TOML with [[world]] tables")  //
      ("world-range", po::value<std::string>()->value_name("A:B"),
       "run the worlds A to B-1 of the ensemble only, with the bits that they have in the whole; default of "
       "--output: <scene>.worlds<A>-<B>.h5")                                                  //
      ("frames", po::value<int>()->value_name("N"), "measured frames; default: the scene's")  //
      ("warmup", po::value<int>()->value_name("N"),
       "frames before the measured ones; default: the scene's, 3");
  add_seed_option("of the solver's row order and of the scene's variation", what);
  add_step_option(stepping::step_option("solver-seed"), what);
  what.add_options()  //
      ("effects", po::value<std::string>()->value_name("+NAME,-NAME"),
       ("for an experiment: + demands an effect that the scene does not call for, - leaves one out; they "
        "are " +
        effect_list())
           .c_str());

  po::options_description how("How to step");
  for (const stepping::StepOption& option : stepping::step_options()) {
    if (option.name == "solver-seed") continue;  // stands beside --seed
    add_step_option(option, how);
    if (option.name == "dt") {
      how.add_options()("steps-per-frame", po::value<int>()->value_name("N"),
                        "steps in a frame; default: the scene's, 3");
    }
  }
  how.add_options()(
      "on-blowup", po::value<std::string>()->default_value("report")->value_name("report|stop|freeze|refine"),
      "what to do about a world that blows up: a number that is not finite, energy gained without a cause, a "
      "joint that gapes, a body that went through something. report: the run goes on (not with a number that "
      "is not finite); stop: the run ends after the frame; freeze: that world stands still from the start of "
      "the step on; refine: the step is done again as 2, 4, 8 or 16 finer ones, and if these blow up too the "
      "world stands still");
  how.add_options()(
      "preset", po::value<std::string>()->value_name("FILE"),
      "a setting that pbreport has chosen from a study (pbreport --write-preset); other options win");

  po::options_description feec("Fast estimation with error control (FEEC)");
  feec.add_options()  //
      ("feec",
       "estimate every frame from the precise state before it is computed: the estimate goes to root at "
       "once, and is dropped when the precise result is there. It is a short run of its own; with sor in "
       "one substep, if a single step is left to estimate, it is the state after the first iterations of "
       "the precise solve")  //
      ("estimate-iterations", po::value<std::string>()->value_name("N"),
       "sweeps of the estimate; default: 1")  //
      ("estimate-stepper", po::value<std::string>()->value_name("quick|direct|sor|bullet|mujoco"),
       "what estimates; default: that of --stepper")  //
      ("estimate-precision", po::value<std::string>()->value_name("double|single"),
       "of an estimate by sor; default: that of --precision, or double")  //
      ("estimate-after", po::value<int>()->value_name("N"),
       "begin with this many precise steps of the frame, and estimate the others: later, and nearer; "
       "default: 0")  //
      ("estimate-by", po::value<std::string>()->value_name("SECONDS"),
       "send the best estimate that is there so long after the start of the frame (3.33ms, or a number of "
       "seconds): precise steps while there is time, then coarse ones; if not even these fit, bodies move on "
       "at their velocities. It follows the clock: estimates, not the precise frames, differ from run to "
       "run");

  po::options_description cut("How to cut the work");
  cut.add_options()  //
      ("decompose", po::value<std::string>()->default_value("auto")->value_name("auto|worlds|spaces"),
       "worlds: each rank owns whole worlds; spaces: a world is cut at its collision spaces, of which each "
       "rank "
       "owns some (sor only), one world over all ranks, several worlds each over a group of them; auto: with "
       "sor spaces for one world of several spaces on several ranks, and for more worlds where there are "
       "more "
       "ranks than worlds and groups are predicted to be faster; else worlds")  //
      ("ranks-per-world", po::value<int>()->value_name("N"),
       "spaces: groups of at most N ranks, as equal as can be, of which each cuts worlds of its own; "
       "default: "
       "as few as make the busiest group's worlds cost least, counted in rows of joints and bodies; one "
       "world: "
       "all ranks")  //
      ("spaces", po::value<std::string>()->value_name("one|many"),
       "many: the scene's named collision spaces; one: all of them as one, with the same physics; default: "
       "the scene's");

  po::options_description write("What to write");
  write.add_options()  //
      ("output,o", po::value<std::string>()->value_name("FILE"),
       "HDF5 file of the run; default: <scene>.h5")  //
      ("no-output", "write no file")                 //
      ("no-xdmf",
       "write no sidecar for ParaView; without this it stands beside the file, <output without .h5>.xdmf")  //
      ("record-every", po::value<int>()->default_value(1)->value_name("N"),
       "store the bodies of every Nth frame; timings are stored for all")  //
      ("record-islands",
       "quick, direct: after each frame measure its last step again, island by island (slow; outside of the "
       "frame's time, and the states stay the same)")  //
      ("record-contacts",
       "store the contacts of the last step of each frame (geoms, place, normal, depth, forces) and the "
       "forces "
       "of its joints")  //
      ("record-residuals",
       "sor: store how far the last step of each frame is from the solution of its constraints")  //
      ("report", po::value<std::string>()->default_value("text")->value_name("text|json"),
       "the summary; json: exactly one JSON document on stdout")  //
      ("budget", po::value<std::string>()->value_name("SECONDS"),
       "time that a frame may take, e.g. 3.33ms (us, ms, s); default: a tenth of 1/30 s");

  po::options_description stop("When to stop, and how to go on");
  stop.add_options()  //
      ("max-time", po::value<double>()->value_name("SECONDS"),
       "stop with a checkpoint at the end of the frame in which so much time has passed since the start")  //
      ("checkpoint", po::value<std::string>()->value_name("FILE"),
       "where the run is saved: on USR1, when it stops early, and after the last frame too if this option is "
       "given; default: <output without .h5>.checkpoint.h5, or the file of --resume")  //
      ("checkpoint-every", po::value<double>()->value_name("SECONDS"),
       "save the run this often, too")  //
      ("wait-limit", po::value<int>()->default_value(1800)->value_name("SECONDS"),
       "end with exit code 1 if ranks wait so long for each other while the run begins or ends; what they "
       "wait for is said on stderr long before")  //
      ("resume", po::value<std::string>()->value_name("FILE"),
       "go on from a checkpoint, with any number of ranks and the same bits. Scene and physics are the "
       "checkpoint's; options that would change them are refused. --frames and --warmup count from the start "
       "of the first run. What follows goes to a file of its own; default: <first output>.from<frame>.h5");

  po::options_description all;
  all.add(what).add(how).add(feec).add(cut).add(write).add(stop).add(common_options_description());
  return all;
}

template <class T>
std::optional<T> given(const po::variables_map& values, const char* name) {
  if (values.count(name) == 0) return std::nullopt;
  return values[name].as<T>();
}

/// The enumerator for the word given to --`name`; `names` are in the order of the enumerators.
template <class Enum, std::size_t N>
Enum choice(const po::variables_map& values, const std::string& name,
            const std::array<std::string_view, N>& names) {
  const std::string word = values[name].as<std::string>();
  if (const auto value = model::enum_from_name<Enum>(word, names)) return *value;
  std::string known;
  for (const std::string_view text : names) known += (known.empty() ? "" : ", ") + std::string(text);
  throw core::InputError("--" + name + " " + word + ": it must be one of " + known);
}

model::EffectChoices effect_choices(const std::string& text) {
  try {
    return effects::parse_effect_choices(text);
  } catch (const core::InputError& error) {
    throw core::InputError("--effects " + text + ": " + error.what());
  }
}

constexpr std::array<std::string_view, 2> report_format_names = {"text", "json"};

/// A time above 0, if given.
std::optional<double> seconds(const po::variables_map& values, const char* name) {
  const std::optional<double> time_s = given<double>(values, name);
  require_input(!time_s || (std::isfinite(*time_s) && *time_s > 0),
                "--" + std::string(name) + " " + std::to_string(time_s.value_or(0)) +
                    " s: a time must be finite and above 0");
  return time_s;
}

Action action_of(const po::variables_map& values) {
  if (values.count("help") != 0) return Action::help;
  if (values.count("version") != 0) return Action::version;
  if (values.count("list-scenes") != 0) return Action::list_scenes;
  return values.count("describe") != 0 ? Action::describe : Action::run;
}

}  // namespace

Manual pbmpi_manual() {
  return {
      .name = "pbmpi",
      .meaning = "simulates many rigid-body worlds over MPI ranks",
      .about = "pbmpi simulates many rigid-body worlds over MPI ranks and shows what accuracy costs in time.",
      .usage = "mpirun -n RANKS pbmpi --scene NAME [options]",
      .options = options_description(),
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
  options.scene = given<std::string>(values, "scene").value_or("");
  options.replicas = given<int>(values, "replicas");
  options.parameters = given<std::string>(values, "parameters");
  if (values.count("world-range") != 0)
    options.world_range = parse_world_range(values["world-range"].as<std::string>());
  options.frames = given<int>(values, "frames");
  options.warmup = given<int>(values, "warmup");
  options.steps_per_frame = given<int>(values, "steps-per-frame");
  options.step = step_arguments(values);
  options.decomposition = choice<Decomposition>(values, "decompose", decomposition_names);
  options.ranks_per_world = given<int>(values, "ranks-per-world");
  options.seed = given_seed(values);
  options.feec = values.count("feec") != 0;
  for (const std::string_view name : estimate_options) {
    const std::string option = "estimate-" + std::string(name);
    if (values.count(option) != 0) options.estimate.emplace(name, values[option].as<std::string>());
  }
  options.estimate_after = given<int>(values, "estimate-after");
  if (values.count("estimate-by") != 0)
    options.estimate_by_s = parse_time_or_seconds(values["estimate-by"].as<std::string>(), "--estimate-by");
  options.output = output_path(values, "output");
  options.no_output = values.count("no-output") != 0;
  options.no_xdmf = values.count("no-xdmf") != 0;
  options.paths = named_paths(values);
  options.record_every = values["record-every"].as<int>();
  options.record_islands = values.count("record-islands") != 0;
  options.record_contacts = values.count("record-contacts") != 0;
  options.record_residuals = values.count("record-residuals") != 0;
  if (values.count("spaces") != 0)
    options.spaces = choice<scenes::SpacesForm>(values, "spaces", spaces_names);
  options.on_blowup = choice<stability::OnBlowup>(values, "on-blowup", stability::on_blowup_names);
  options.effects = effect_choices(given<std::string>(values, "effects").value_or(""));
  options.report = choice<ReportFormat>(values, "report", report_format_names);
  options.checkpoint = output_path(values, "checkpoint");
  options.checkpoint_every_s = seconds(values, "checkpoint-every");
  options.max_time_s = seconds(values, "max-time");
  options.resume = given<std::string>(values, "resume");
  options.wait_limit_s = values["wait-limit"].as<int>();
  require_input(options.wait_limit_s >= 1, "--wait-limit " + std::to_string(options.wait_limit_s) +
                                               ": it must be at least 1, the seconds that ranks may wait");
  if (values.count("budget") != 0)
    options.budget_s = parse_time_or_seconds(values["budget"].as<std::string>(), "--budget");
  const bool needs_scene = options.action == Action::run || options.action == Action::describe;
  require_input(!needs_scene || !options.scene.empty() || options.resume,
                "no scene given; name one with --scene (see --list-scenes)");
  require_input(!(options.no_output && options.output),
                "--output and --no-output exclude each other; drop one");
  return options;
}

}  // namespace pbmpi::app
