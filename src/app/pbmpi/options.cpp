#include "app/pbmpi/options.h"

#include <array>
#include <cmath>
#include <sstream>
#include <string_view>

#include "core/error.h"
#include "model/effects.h"
#include "model/names.h"

namespace pbmpi::app {

namespace po = boost::program_options;
using core::require_input;

namespace {

std::string effect_list() {
  std::string list;
  for (const model::Effect& effect : model::effect_registry())
    list += (list.empty() ? "" : ", ") + std::string(effect.name);
  return list;
}

po::options_description options_description() {
  po::options_description what("What to simulate");
  what.add_options()  //
      ("scene", po::value<std::string>()->value_name("NAME|FILE.toml"),
       "a scene that pbmpi brings (--list-scenes), or a scene file of your own")  //
      ("list-scenes", "list the scenes that pbmpi brings")                        //
      ("describe",
       "print the resolved scene, the step plan, who owns what and the size of the file; run nothing")  //
      ("replicas", po::value<int>()->value_name("N"), "worlds; default: the scene's")                   //
      ("frames", po::value<int>()->value_name("N"), "measured frames; default: the scene's")            //
      ("warmup", po::value<int>()->value_name("N"),
       "frames before the measured ones; default: the scene's, 3")  //
      ("seed", po::value<std::uint64_t>()->default_value(1)->value_name("N"),
       "of the solver's row order and of the scene's variation")  //
      ("solver-seed", po::value<std::uint64_t>()->value_name("N"),
       "of the solver's row order alone: runs that differ in it show the noise floor; default: --seed")  //
      ("effects", po::value<std::string>()->value_name("+NAME,-NAME"),
       ("for an experiment: + demands an effect that the scene does not call for, - leaves one out; they "
        "are " +
        effect_list())
           .c_str());

  po::options_description how("How to step");
  how.add_options()  //
      ("stepper", po::value<std::string>()->default_value("sor")->value_name("sor|quick|direct"),
       "sor: pbmpi's own projected SOR, worlds side by side in vector lanes; quick: ODE's iterative "
       "dWorldQuickStep; direct: ODE's big-matrix dWorldStep")  //
      ("dt", po::value<double>()->value_name("SECONDS"),
       "length of a step [s]; default: the scene's, 0.01")                                                 //
      ("steps-per-frame", po::value<int>()->value_name("N"), "steps in a frame; default: the scene's, 3")  //
      ("iterations", po::value<int>()->value_name("N"),
       "sweeps of the iterative solver, in each substep; default: the scene's, 20")  //
      ("substeps", po::value<int>()->default_value(1)->value_name("N"),
       "sor: parts of a step that share its collision detection")  //
      ("sor-factor", po::value<double>()->value_name("X"),
       "sor: over-relaxation, above 0 and below 2; default: 1.3, as in ODE")  //
      ("warm-start", po::value<double>()->value_name("X"),
       "sor: share of their impulses with which joints and contacts start a substep after the first, 0 to 1; "
       "default: 0, none; needs --substeps")  //
      ("row-order", po::value<std::string>()->default_value("shuffled")->value_name("shuffled|fixed"),
       "sor: the joints' order in the sweeps: another every 8 iterations, or always the model's")  //
      ("precision", po::value<std::string>()->default_value("double")->value_name("double|single"),
       "sor: number type of the solver")  //
      ("simd", po::value<std::string>()->default_value("auto")->value_name("auto|sse2|avx2|avx512|off"),
       "sor: vector instructions; the result is the same with all")  //
      ("colliders", po::value<std::string>()->default_value("lanes")->value_name("lanes|ode"),
       "sor: what collides pairs of geoms; lanes: kernels over vector lanes, ode: dCollide");

  how.add_options()(
      "preset", po::value<std::string>()->value_name("FILE"),
      "a setting that pbreport has chosen from a study (pbreport --write-preset); other options win");

  po::options_description feec("Fast estimation with error control (FEEC)");
  feec.add_options()  //
      ("feec",
       "estimate every frame from the precise state before it is computed: the estimate goes to root at "
       "once, and is dropped when the precise result is there. It is a short run of its own; with sor and "
       "one "
       "step of one substep a frame it is the state after the first iterations of the precise solve")   //
      ("estimate-iterations", po::value<int>()->value_name("N"), "sweeps of the estimate; default: 1")  //
      ("estimate-stepper", po::value<std::string>()->value_name("quick|direct|sor"),
       "what estimates; default: that of --stepper")  //
      ("estimate-precision", po::value<std::string>()->value_name("double|single"),
       "of an estimate by sor; default: that of --precision, or double");

  po::options_description cut("How to cut the work");
  cut.add_options()  //
      ("decompose", po::value<std::string>()->default_value("auto")->value_name("auto|worlds|spaces"),
       "worlds: each rank owns whole worlds; spaces: each rank owns collision spaces of the one world (sor "
       "only); auto: spaces for one world of several spaces on several ranks with sor and without --feec, "
       "else worlds")  //
      ("spaces", po::value<std::string>()->value_name("one|many"),
       "many: the scene's named collision spaces; one: all of them as one, with the same physics; default: "
       "the scene's");

  po::options_description write("What to write");
  write.add_options()  //
      ("output,o", po::value<std::string>()->value_name("FILE"),
       "HDF5 file of the run; default: <scene>.h5")  //
      ("no-output", "write no file")                 //
      ("record-every", po::value<int>()->default_value(1)->value_name("N"),
       "store the bodies of every Nth frame; timings are stored for all")  //
      ("record-islands",
       "quick, direct: after each frame measure its last step again, island by island (slow; outside of the "
       "frame's time, and the states stay the same)")  //
      ("record-residuals",
       "sor: store how far the last step of each frame is from the solution of its constraints")  //
      ("report", po::value<std::string>()->default_value("text")->value_name("text|json"),
       "the summary; json: exactly one JSON document on stdout");

  po::options_description all;
  all.add(what).add(how).add(feec).add(cut).add(write).add(common_options_description());
  return all;
}

template <class T>
std::optional<T> given(const po::variables_map& values, const char* name) {
  if (values.count(name) == 0) return std::nullopt;
  return values[name].as<T>();
}

/// The enumerator that belongs to the word given for --`name`; `names` are in the order of the enumerators.
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
    return model::parse_effect_choices(text);
  } catch (const core::InputError& error) {
    throw core::InputError("--effects " + text + ": " + error.what());
  }
}

/// The same for an option that has no default.
template <class Enum, std::size_t N>
std::optional<Enum> choice_if_given(const po::variables_map& values, const std::string& name,
                                    const std::array<std::string_view, N>& names) {
  if (values.count(name) == 0) return std::nullopt;
  return choice<Enum>(values, name, names);
}

constexpr std::array<std::string_view, 3> decomposition_names = {"auto", "worlds", "spaces"};
constexpr std::array<std::string_view, 2> spaces_names = {"one", "many"};
constexpr std::array<std::string_view, 2> report_format_names = {"text", "json"};

Action action_of(const po::variables_map& values) {
  if (values.count("help") != 0) return Action::help;
  if (values.count("version") != 0) return Action::version;
  if (values.count("list-scenes") != 0) return Action::list_scenes;
  return values.count("describe") != 0 ? Action::describe : Action::run;
}

void require_at_least(int value, int least, const char* option) {
  require_input(value >= least, std::string(option) + " " + std::to_string(value) + ": it must be at least " +
                                    std::to_string(least));
}

}  // namespace

std::string help_text() {
  std::ostringstream text;
  text << "pbmpi simulates many rigid-body worlds over MPI ranks and shows what accuracy costs in time.\n\n"
       << "Usage: mpirun -n RANKS pbmpi --scene NAME [options]\n\n"
       << options_description()
       << "\nExit codes: 0 done; 1 the simulation failed (what was written is readable); "
       << "2 bad usage or bad input; 75 stopped early on request.\n"
       << "Signals: INT, TERM and USR2 finish the frame, close the file and end with 75 (send USR2 to "
          "mpirun).\n"
       << "Example: mpirun -n 2 pbmpi --scene 100CrSk --report json\n";
  return text.str();
}

Options parse_options(const std::vector<std::string>& args) {
  const po::variables_map values = parse_command_line(args, options_description());
  Options options;
  options.action = action_of(values);
  options.command_line = "pbmpi";
  for (const std::string& arg : args) options.command_line += " " + arg;
  options.common = common_options(values);
  options.scene = given<std::string>(values, "scene").value_or("");
  options.replicas = given<int>(values, "replicas");
  options.frames = given<int>(values, "frames");
  options.warmup = given<int>(values, "warmup");
  options.steps_per_frame = given<int>(values, "steps-per-frame");
  options.iterations = given<int>(values, "iterations");
  options.dt_s = given<double>(values, "dt");
  require_input(!options.dt_s || (std::isfinite(*options.dt_s) && *options.dt_s > 0),
                "--dt " + std::to_string(options.dt_s.value_or(0)) + " s: a step must be finite and above 0");
  options.stepper = choice<model::StepperKind>(values, "stepper", model::stepper_kind_names);
  options.substeps = values["substeps"].as<int>();
  options.sor_factor = given<double>(values, "sor-factor");
  require_input(!options.sor_factor || (*options.sor_factor > 0 && *options.sor_factor < 2),
                "--sor-factor " + std::to_string(options.sor_factor.value_or(0)) +
                    ": the iteration converges above 0 and below 2 only");
  options.warm_start = given<double>(values, "warm-start");
  require_input(!options.warm_start || (*options.warm_start >= 0 && *options.warm_start <= 1),
                "--warm-start " + std::to_string(options.warm_start.value_or(0)) +
                    ": the share of the impulses to take over is 0 to 1");
  options.row_order = choice<model::RowOrder>(values, "row-order", model::row_order_names);
  options.precision = choice<model::Precision>(values, "precision", model::precision_names);
  options.simd = choice<model::Simd>(values, "simd", model::simd_names);
  options.colliders = choice<model::Colliders>(values, "colliders", model::colliders_names);
  options.decomposition = choice<Decomposition>(values, "decompose", decomposition_names);
  options.seed = values["seed"].as<std::uint64_t>();
  options.solver_seed = given<std::uint64_t>(values, "solver-seed");
  options.feec = values.count("feec") != 0;
  options.estimate_iterations = given<int>(values, "estimate-iterations");
  options.estimate_stepper =
      choice_if_given<model::StepperKind>(values, "estimate-stepper", model::stepper_kind_names);
  options.estimate_precision =
      choice_if_given<model::Precision>(values, "estimate-precision", model::precision_names);
  options.output = given<std::string>(values, "output");
  options.no_output = values.count("no-output") != 0;
  options.record_every = values["record-every"].as<int>();
  options.record_islands = values.count("record-islands") != 0;
  options.record_residuals = values.count("record-residuals") != 0;
  if (values.count("spaces") != 0)
    options.spaces = choice<scenes::SpacesForm>(values, "spaces", spaces_names);
  options.effects = effect_choices(given<std::string>(values, "effects").value_or(""));
  options.report = choice<ReportFormat>(values, "report", report_format_names);
  const bool needs_scene = options.action == Action::run || options.action == Action::describe;
  require_input(!needs_scene || !options.scene.empty(),
                "no scene given; name one with --scene (see --list-scenes)");
  require_input(!(options.no_output && options.output),
                "--output and --no-output exclude each other; drop one");
  return options;
}

/// The estimate's own settings over those of the precise stepper, whose step and seed it shares.
std::optional<model::StepperSettings> resolve_estimate(const Options& options,
                                                       const model::StepperSettings& precise) {
  const bool asked = options.estimate_iterations || options.estimate_stepper || options.estimate_precision;
  require_input(
      options.feec || !asked,
      "--estimate-iterations, --estimate-stepper and --estimate-precision say how --feec estimates; "
      "give --feec too");
  if (!options.feec) return std::nullopt;
  model::StepperSettings estimate = precise;
  estimate.kind = options.estimate_stepper.value_or(precise.kind);
  estimate.iterations = options.estimate_iterations.value_or(1);
  estimate.precision = options.estimate_precision.value_or(precise.precision);
  estimate.substeps = 1;
  estimate.warm_start = 0;
  estimate.residuals = false;
  require_at_least(estimate.iterations, 1, "--estimate-iterations");
  require_input(estimate.kind == model::StepperKind::sor || !options.estimate_precision,
                "--estimate-precision is an option of an estimate by sor; give --estimate-stepper sor");
  if (estimate.kind != model::StepperKind::sor) estimate.precision = model::Precision::double_;
  return estimate;
}

/// The precise solve can be looked at where it is the frame's only one, and passes the wanted iteration.
EstimateSource estimate_source(const RunSpec& spec) {
  const bool one_solve =
      spec.stepper.kind == model::StepperKind::sor && spec.steps_per_frame == 1 && spec.stepper.substeps == 1;
  const bool passes = spec.estimate && spec.estimate->kind == spec.stepper.kind &&
                      spec.estimate->precision == spec.stepper.precision &&
                      spec.estimate->iterations <= spec.stepper.iterations;
  return one_solve && passes ? EstimateSource::same_solve : EstimateSource::short_run;
}

RunSpec resolve(const Options& options, const scenes::Scene& scene) {
  const scenes::RunDefaults& defaults = scene.defaults();
  RunSpec spec;
  spec.num_worlds = options.replicas.value_or(defaults.replicas);
  spec.warmup = options.warmup.value_or(defaults.warmup);
  spec.frames = options.frames.value_or(defaults.frames);
  spec.steps_per_frame = options.steps_per_frame.value_or(defaults.steps_per_frame);
  spec.stepper.kind = options.stepper;
  spec.stepper.dt_s = options.dt_s.value_or(defaults.dt_s);
  spec.stepper.iterations = options.iterations.value_or(defaults.iterations);
  spec.scene_seed = options.seed;
  spec.stepper.seed = options.solver_seed.value_or(options.seed);
  spec.stepper.substeps = options.substeps;
  spec.stepper.sor_factor = options.sor_factor.value_or(spec.stepper.sor_factor);
  spec.stepper.warm_start = options.warm_start.value_or(0);
  spec.stepper.row_order = options.row_order;
  spec.stepper.precision = options.precision;
  spec.stepper.simd = options.simd;
  spec.stepper.colliders = options.colliders;
  spec.record_every = options.record_every;
  spec.decomposition = options.decomposition;
  if (!options.no_output) spec.output = options.output.value_or(scene.name() + ".h5");
  require_at_least(spec.num_worlds, 1, "--replicas");
  require_at_least(spec.warmup, 0, "--warmup");
  require_at_least(spec.frames, 1, "--frames");
  require_at_least(spec.steps_per_frame, 1, "--steps-per-frame");
  require_at_least(spec.stepper.iterations, 1, "--iterations");
  require_at_least(spec.stepper.substeps, 1, "--substeps");
  const bool own_options =
      spec.stepper.substeps != 1 || options.sor_factor || options.warm_start ||
      options.row_order != model::RowOrder::shuffled || options.precision != model::Precision::double_ ||
      options.simd != model::Simd::automatic || options.colliders != model::Colliders::lanes;
  require_input(
      options.stepper == model::StepperKind::sor || !own_options,
      "--substeps, --sor-factor, --warm-start, --row-order, --precision, --simd and --colliders are "
      "options of --stepper sor; ODE's steppers have none of them");
  require_input(
      spec.stepper.warm_start == 0 || spec.stepper.substeps > 1,
      "--warm-start carries impulses from one substep to the next, and there is one; give --substeps "
      "2 or more");
  require_at_least(spec.record_every, 1, "--record-every");
  spec.spaces = scene.defaults().spaces;
  spec.effects = scene.defaults().effects;
  spec.record_islands = options.record_islands;
  spec.stepper.profile = options.record_islands;
  require_input(!options.record_islands || options.stepper != model::StepperKind::sor,
                "--record-islands: --stepper sor solves many islands in one vector and has no time of one; "
                "use quick or direct");
  require_input(!options.record_islands || !options.no_output,
                "--record-islands writes into the run's file; drop --no-output");
  spec.stepper.residuals = options.record_residuals;
  require_input(!options.record_residuals || options.stepper == model::StepperKind::sor,
                "--record-residuals: ODE's steppers do not show their rows; use --stepper sor");
  require_input(!options.record_residuals || !options.no_output,
                "--record-residuals writes into the run's file; drop --no-output");
  spec.estimate = resolve_estimate(options, spec.stepper);
  spec.estimate_source = estimate_source(spec);
  return spec;
}

namespace {

/// Why this run's worlds stay whole, and what to do about it; nothing if one may be cut.
std::optional<std::string> why_whole(const RunSpec& spec) {
  if (spec.stepper.kind != model::StepperKind::sor) {
    return "--decompose spaces needs --stepper sor (ODE's solvers give no access to single islands, and quick"
           " draws from one random seed for the whole world); add --stepper sor, or use --decompose worlds";
  }
  if (spec.num_worlds != 1) {
    return "--decompose spaces cuts one world, and there are " + std::to_string(spec.num_worlds) +
           "; use --replicas 1 or --decompose worlds";
  }
  if (spec.stepper.residuals)
    return "--record-residuals: no rank of a world that is cut has all its rows; use --decompose worlds";
  if (spec.estimate)
    return "--feec: no rank of a world that is cut has all of it to estimate from; use --decompose worlds";
  return std::nullopt;
}

}  // namespace

Decomposition decompose(const RunSpec& spec, int num_spaces, int num_ranks) {
  const std::optional<std::string> reason = why_whole(spec);
  if (spec.decomposition == Decomposition::automatic) {
    return !reason && num_spaces > 1 && num_ranks > 1 ? Decomposition::spaces : Decomposition::worlds;
  }
  require_input(spec.decomposition == Decomposition::worlds || !reason, reason.value_or(""));
  return spec.decomposition;
}

}  // namespace pbmpi::app
