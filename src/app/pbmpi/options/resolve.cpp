/// Resolves options and the scene's defaults to a run, and refuses impossible ones.
#include <array>
#include <filesystem>
#include <regex>
#include <string_view>

#include "app/pbmpi/options/options.h"
#include "core/error.h"
#include "engines/optional_engines.h"
#include "stepping/names.h"

namespace pbmpi::app {

using core::require_input;

namespace {

void require_at_least(int value, int least, const char* option) {
  require_input(value >= least, std::string(option) + " " + std::to_string(value) + ": it must be at least " +
                                    std::to_string(least));
}

/// The upper bound is a number that no run reaches, so that sums and products of such numbers have room.
void require_between(int value, int least, int most, const char* option) {
  require_at_least(value, least, option);
  require_input(value <= most, std::string(option) + " " + std::to_string(value) + ": it must be at most " +
                                   std::to_string(most));
}

/// The estimate's own settings over those of the precise stepper, whose step and seed it shares.
stepping::StepperSettings resolve_estimate_stepper(const Options& options,
                                                   const stepping::StepperSettings& precise) {
  stepping::StepperSettings estimate = default_estimate(precise);
  for (const auto& [name, text] : options.estimate)
    set(stepping::step_option(name), text, "--estimate-" + name, estimate);
  const bool has_precision = traits_of(estimate.kind).has_precision;
  require_input(has_precision || !options.estimate.contains("precision"),
                "--estimate-precision is an option of an estimate by sor; give --estimate-stepper sor");
  engines::require_in_build(estimate.kind, "--estimate-stepper " + std::string(name_of(estimate.kind)));
  if (!has_precision) estimate.precision = stepping::Precision::double_;
  return estimate;
}

std::optional<EstimateSpec> resolve_estimate(const Options& options, const RunSpec& spec) {
  require_input(
      options.feec || (options.estimate.empty() && !options.estimate_after && !options.estimate_by_s),
      "--estimate-iterations, --estimate-stepper, --estimate-precision, --estimate-after and "
      "--estimate-by say how --feec estimates; give --feec too");
  if (!options.feec) return std::nullopt;
  require_input(!options.estimate_after || !options.estimate_by_s,
                "--estimate-after and --estimate-by exclude each other: the one says how many steps of a "
                "frame are precise, the other leaves it to the clock");
  EstimateSpec estimate;
  estimate.stepper = resolve_estimate_stepper(options, spec.stepper);
  estimate.after = options.estimate_after.value_or(0);
  estimate.due_s = options.estimate_by_s;
  require_between(estimate.after, 0, spec.steps_per_frame - 1, "--estimate-after");
  estimate.source = source_of(estimate, spec.stepper, spec.steps_per_frame);
  return estimate;
}

namespace fs = std::filesystem;

/// "run.xdmf" for "run.h5"; any other name gets ".xdmf" appended, so that two runs share none, except r and
/// r.h5.
std::string sidecar_of(const std::string& output) {
  const fs::path path(output);
  return path.extension() == ".h5" ? fs::path(path).replace_extension(".xdmf").string() : output + ".xdmf";
}

/// "run.h5" -> "run"
std::string stem(const std::string& path) {
  const fs::path file(path);
  return file.extension() == ".h5" ? fs::path(file).replace_extension().string() : path;
}

/// The run after a checkpoint writes a file of its own beside that of the run which wrote the checkpoint.
std::string output_after(const ResumePoint& from) {
  const std::string first = std::regex_replace(stem(from.output), std::regex("\\.from[0-9]+$"), "");
  const std::string path = first + ".from" + std::to_string(from.frames) + ".h5";
  // A file below the current folder has a shorter name relative to it.
  const std::string near = fs::proximate(path).string();
  return near.starts_with("..") ? path : near;
}

/// "column20" for "hard/rest/column20".
std::string file_stem(const scenes::Scene& scene) { return scene.name().substr(scene.name().rfind('/') + 1); }

/// The default name of the run's files: jobs that share an ensemble may run in one folder.
std::string name_of_run(const Options& options, const scenes::Scene& scene) {
  const std::optional<WorldRange>& range = options.world_range;
  return file_stem(scene) +
         (range ? ".worlds" + std::to_string(range->first) + "-" + std::to_string(range->end) : "");
}

std::optional<std::string> resolve_output(const Options& options, const scenes::Scene& scene,
                                          const ResumePoint& from) {
  if (options.no_output) return std::nullopt;
  if (options.output) {
    require_input(from.output.empty() || !core::is_same_file(*options.output, from.output),
                  "--output " + *options.output +
                      ": the frames before the checkpoint are in that file; name "
                      "another, or leave the option out");
    return options.output;
  }
  if (from.path.empty()) return name_of_run(options, scene) + ".h5";
  if (from.output.empty()) return std::nullopt;
  return output_after(from);
}

CheckpointSpec resolve_checkpoint(const Options& options, const scenes::Scene& scene, const ResumePoint& from,
                                  const std::optional<std::string>& output) {
  CheckpointSpec spec;
  const std::string beside = stem(output.value_or(name_of_run(options, scene))) + ".checkpoint.h5";
  spec.path = options.checkpoint.value_or(from.path.empty() ? beside : from.path);
  spec.every_s = options.checkpoint_every_s;
  spec.max_time_s = options.max_time_s;
  spec.at_end = options.checkpoint.has_value();
  spec.resumed_from = from.path;
  spec.first_frame = from.frames;
  require_input(!output || !core::is_same_file(*output, spec.path),
                "--checkpoint " + spec.path + ": that is the run's own output; name another file");
  require_input(
      !output || from.path.empty() || !core::is_same_file(*output, from.path),
      "--output " + output.value_or("") + ": that is the checkpoint to go on from; name another file");
  return spec;
}

/// No path that is written may be read too, or written twice, whether it was given or derived from another
/// name.
void require_separate_files(const Options& options, const RunSpec& spec) {
  std::vector<core::NamedPath> paths;
  for (const core::NamedPath& path : options.paths) {
    if (!path.written) paths.push_back(path);
  }
  if (spec.output) paths.push_back({"--output", *spec.output, true});
  if (spec.sidecar) paths.push_back({"the sidecar for ParaView (--no-xdmf)", *spec.sidecar, true});
  // Without --checkpoint a saved run replaces the checkpoint that it came from.
  paths.push_back({"--checkpoint", spec.checkpoint.path, true});
  if (!spec.checkpoint.resumed_from.empty() &&
      !core::is_same_file(spec.checkpoint.resumed_from, spec.checkpoint.path))
    paths.push_back({"--resume", spec.checkpoint.resumed_from, false});
  core::require_separate(paths);
}

/// How many worlds the ensemble has, and which of them belong to the run.
void resolve_worlds(const Options& options, const scenes::Scene& scene, std::optional<int> num_rows,
                    RunSpec& spec) {
  const int asked = options.replicas.value_or(scene.defaults().replicas);
  require_at_least(asked, 1, "--replicas");
  require_input(!num_rows || !options.replicas || asked == *num_rows,
                "--replicas " + std::to_string(asked) + ": the table of --parameters has " +
                    std::to_string(num_rows.value_or(0)) +
                    " rows, a world each; leave the option out, or give a table of as many rows");
  spec.ensemble_worlds = num_rows.value_or(asked);
  spec.range = options.world_range;
  spec.num_worlds = spec.range ? spec.range->end - spec.range->first : spec.ensemble_worlds;
  require_input(!spec.range || spec.range->end <= spec.ensemble_worlds,
                "--world-range " + to_text(spec.range.value_or(WorldRange{})) +
                    ": the ensemble has worlds 0 to " + std::to_string(spec.ensemble_worlds - 1) +
                    "; end the range at " + std::to_string(spec.ensemble_worlds) + " at most");
}

stepping::StepperSettings resolve_step(const Options& options, const scenes::RunDefaults& defaults) {
  stepping::StepperSettings step =
      settle_step(options.step, {defaults.dt_s, defaults.iterations, options.seed}, "--");
  engines::require_in_build(step.kind, "--stepper " + std::string(name_of(step.kind)));
  step.profile = options.record_islands;
  step.residuals = options.record_residuals;
  step.contacts = options.record_contacts;
  return step;
}

/// Throws core::InputError for output that this kind of stepper cannot record, or has no file for.
void require_recordable(const Options& options, stepping::StepperKind kind) {
  const stepping::StepperTraits& traits = traits_of(kind);
  require_input(!options.record_islands || traits.profiles_islands,
                "--record-islands: --stepper " + std::string(name_of(kind)) +
                    (traits.has_lanes ? " solves many islands in one vector and has no time of one; "
                                      : " has no time of single islands; ") +
                    "use quick or direct");
  require_input(!options.record_islands || !options.no_output,
                "--record-islands writes into the run's file; drop --no-output");
  require_input(!options.record_islands || !stability::mends(options.on_blowup),
                "--record-islands measures the last step of a frame again, and --on-blowup " +
                    std::string(stability::on_blowup_names[static_cast<std::size_t>(options.on_blowup)]) +
                    " may have replaced it; use --on-blowup report or stop");
  require_input(!options.record_contacts || !options.no_output,
                "--record-contacts writes into the run's file; drop --no-output");
  require_input(!options.record_residuals || traits.shows_residuals,
                "--record-residuals: --stepper " + std::string(name_of(kind)) +
                    " does not show its rows; use --stepper sor");
  require_input(!options.record_residuals || !options.no_output,
                "--record-residuals writes into the run's file; drop --no-output");
}

}  // namespace

WorldRange parse_world_range(const std::string& text) {
  static const std::regex form("([0-9]{1,9}):([0-9]{1,9})");
  std::smatch match;
  require_input(std::regex_match(text, match, form),
                "--world-range " + text + ": give A:B, e.g. 0:50 for the worlds 0 to 49");
  const WorldRange range{std::stoi(match[1]), std::stoi(match[2])};
  require_input(range.first < range.end,
                "--world-range " + text + ": there is no world from A to B-1; give B above A");
  return range;
}

std::string to_text(const WorldRange& range) {
  return std::to_string(range.first) + ":" + std::to_string(range.end);
}

RunSpec resolve(const Options& options, const scenes::Scene& scene, const ResumePoint& from,
                std::optional<int> num_rows) {
  const scenes::RunDefaults& defaults = scene.defaults();
  RunSpec spec;
  resolve_worlds(options, scene, num_rows, spec);
  spec.warmup = options.warmup.value_or(defaults.warmup);
  spec.frames = options.frames.value_or(defaults.frames);
  spec.steps_per_frame = options.steps_per_frame.value_or(defaults.steps_per_frame);
  spec.scene_seed = options.seed;
  spec.stepper = resolve_step(options, defaults);
  spec.record_every = options.record_every;
  spec.budget_s = options.budget_s;
  spec.decomposition = options.decomposition;
  spec.ranks_per_world = options.ranks_per_world;
  require_at_least(spec.ranks_per_world.value_or(1), 1, "--ranks-per-world");
  spec.output = resolve_output(options, scene, from);
  spec.checkpoint = resolve_checkpoint(options, scene, from, spec.output);
  if (spec.output && !options.no_xdmf) spec.sidecar = sidecar_of(*spec.output);
  require_separate_files(options, spec);
  constexpr int most_frames = 1'000'000'000, most_steps = 1'000'000;
  require_between(spec.warmup, 0, most_frames, "--warmup");
  require_between(spec.frames, 1, most_frames, "--frames");
  require_between(spec.steps_per_frame, 1, most_steps, "--steps-per-frame");
  require_input(spec.total_frames() > from.frames,
                "--resume " + from.path + ": all " + std::to_string(spec.total_frames()) + " frames (" +
                    std::to_string(spec.warmup) + " of warm-up) are done; give --frames above " +
                    std::to_string(from.frames - spec.warmup) + " to go on");
  require_at_least(spec.record_every, 1, "--record-every");
  spec.spaces = scene.defaults().spaces;
  spec.effects = scene.defaults().effects;
  spec.record_islands = options.record_islands;
  spec.on_blowup = options.on_blowup;
  require_recordable(options, spec.stepper.kind);
  spec.estimate = resolve_estimate(options, spec);
  return spec;
}

}  // namespace pbmpi::app
