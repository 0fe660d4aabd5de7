/// Resolves options and the scene's defaults to a run, and refuses impossible ones.
#include <array>
#include <filesystem>
#include <regex>
#include <sstream>
#include <utility>

#include "app/common/step_arguments.h"
#include "app/pbmpi/options/options.h"
#include "app/pbmpi/options/run_options.h"
#include "core/error.h"
#include "core/system/mounts.h"
#include "engines/optional_engines.h"
#include "stepping/names.h"
#include "stepping/option_values.h"

namespace pbmpi::app {

using core::require_input;

namespace {

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
std::string name_of_run(const RunSpec& asked, const scenes::Scene& scene) {
  const std::optional<WorldRange>& range = asked.range;
  return file_stem(scene) +
         (range ? ".worlds" + std::to_string(range->first) + "-" + std::to_string(range->end) : "");
}

std::optional<std::string> resolve_output(const RunSpec& asked, const scenes::Scene& scene,
                                          const ResumePoint& from) {
  if (asked.no_output) return std::nullopt;
  if (asked.output) {
    require_input(from.output.empty() || !core::is_same_file(*asked.output, from.output),
                  "--output " + *asked.output +
                      ": the frames before the checkpoint are in that file; name "
                      "another, or leave the option out");
    return asked.output;
  }
  if (from.path.empty()) return name_of_run(asked, scene) + ".h5";
  if (from.output.empty()) return std::nullopt;
  return output_after(from);
}

/// spec.output: as resolved.
CheckpointSpec resolve_checkpoint(const RunSpec& spec, const scenes::Scene& scene, const ResumePoint& from) {
  CheckpointSpec checkpoint;
  const std::string beside = stem(spec.output.value_or(name_of_run(spec, scene))) + ".checkpoint.h5";
  checkpoint.path = spec.checkpoint_file.value_or(from.path.empty() ? beside : from.path);
  checkpoint.resumed_from = from.path;
  checkpoint.first_frame = from.frames;
  require_input(!spec.output || !core::is_same_file(*spec.output, checkpoint.path),
                "--checkpoint " + checkpoint.path + ": that is the run's own output; name another file");
  require_input(
      !spec.output || from.path.empty() || !core::is_same_file(*spec.output, from.path),
      "--output " + spec.output.value_or("") + ": that is the checkpoint to go on from; name another file");
  return checkpoint;
}

/// No path that is written may be read too, or written twice, whether it was given or derived from another
/// name.
void require_separate_files(std::span<const core::NamedPath> named, const RunSpec& spec) {
  std::vector<core::NamedPath> paths;
  for (const core::NamedPath& path : named) {
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
void resolve_worlds(bool asks_for_replicas, std::optional<int> num_rows, RunSpec& spec) {
  require_input(!num_rows || !asks_for_replicas || spec.replicas == *num_rows,
                "--replicas " + std::to_string(spec.replicas) + ": the table of --parameters has " +
                    std::to_string(num_rows.value_or(0)) +
                    " rows, a world each; leave the option out, or give a table of as many rows");
  spec.replicas = num_rows.value_or(spec.replicas);
  spec.num_worlds = spec.range ? spec.range->end - spec.range->first : spec.replicas;
  require_input(!spec.range || spec.range->end <= spec.replicas,
                "--world-range " + to_text(spec.range.value_or(WorldRange{})) +
                    ": the ensemble has worlds 0 to " + std::to_string(spec.replicas - 1) +
                    "; end the range at " + std::to_string(spec.replicas) + " at most");
}

stepping::StepperSettings resolve_step(const stepping::StepChoices& choices, const RunSpec& spec,
                                       const scenes::RunDefaults& defaults) {
  stepping::StepperSettings step =
      settle_step(choices, {defaults.dt_s, defaults.iterations, spec.seed}, "--");
  engines::require_in_build(step.kind, "--stepper " + std::string(name_of(step.kind)));
  step.profile = spec.records.has(Record::islands);
  step.residuals = spec.records.has(Record::residuals);
  step.contacts = spec.records.has(Record::contacts);
  return step;
}

/// Throws core::InputError for output that this kind of stepper cannot record, or has no file for.
void require_recordable(const RunSpec& spec) {
  const stepping::StepperKind kind = spec.stepper.kind;
  const stepping::StepperTraits& traits = traits_of(kind);
  const bool has_islands = spec.records.has(Record::islands);
  require_input(!has_islands || traits.profiles_islands,
                "--record islands: --stepper " + std::string(name_of(kind)) +
                    (traits.has_lanes ? " solves many islands in one vector and has no time of one; "
                                      : " has no time of single islands; ") +
                    "use quick or direct");
  require_input(!has_islands || !stability::mends(spec.on_blowup),
                "--record islands measures the last step of a frame again, and --on-blowup " +
                    std::string(stability::on_blowup_names[static_cast<std::size_t>(spec.on_blowup)]) +
                    " may have replaced it; use --on-blowup report or stop");
  require_input(!spec.records.has(Record::residuals) || traits.shows_residuals,
                "--record residuals: --stepper " + std::string(name_of(kind)) +
                    " does not show its rows; use --stepper sor");
  const std::string recorded = to_text(spec.records);
  require_input(recorded.empty() || !spec.no_output,
                "--record " + recorded + " writes into the run's file; drop --no-output");
}

}  // namespace

WorldRange parse_world_range(const std::string& text, const std::string& what) {
  static const std::regex form("([0-9]{1,9}):([0-9]{1,9})");
  std::smatch match;
  require_input(std::regex_match(text, match, form),
                what + " " + text + ": give A:B, e.g. 0:50 for the worlds 0 to 49");
  const WorldRange range{std::stoi(match[1]), std::stoi(match[2])};
  require_input(range.first < range.end,
                what + " " + text + ": there is no world from A to B-1; give B above A");
  return range;
}

Records parse_records(const std::string& text, const std::string& what) {
  Records records;
  std::istringstream list(text);
  for (std::string name; std::getline(list, name, ',');) {
    const auto one = stepping::read_word<Record>(name, what, record_names);
    records.chosen[static_cast<std::size_t>(one)] = true;
  }
  return records;
}

std::string to_text(const Records& records) {
  std::string text;
  for (std::size_t i = 0; i < record_names.size(); ++i) {
    if (records.chosen[i]) text += (text.empty() ? "" : ",") + std::string(record_names[i]);
  }
  return text;
}

std::string to_text(const WorldRange& range) {
  return std::to_string(range.first) + ":" + std::to_string(range.end);
}

RunSpec resolve(const Options& options, const scenes::Scene& scene, const ResumePoint& from,
                std::optional<int> num_rows) {
  const scenes::RunDefaults& defaults = scene.defaults();
  RunSpec spec = options.run;
  for (const RunOption& option : run_options()) {
    if (!options.given.contains(option.name)) take_default(option, defaults, spec);
  }
  spec.effects = defaults.effects;
  resolve_worlds(options.given.contains("replicas"), num_rows, spec);
  spec.stepper = resolve_step(options.step, spec, defaults);
  if (!from.output.empty())
    core::require_answers(std::array{core::NamedPath{"--resume: the run of", from.output, false}});
  spec.output = resolve_output(options.run, scene, from);
  spec.checkpoint = resolve_checkpoint(spec, scene, from);
  if (spec.output && !spec.no_xdmf) spec.sidecar = sidecar_of(*spec.output);
  require_separate_files(options.paths, spec);
  require_input(spec.total_frames() > from.frames,
                "--resume " + from.path + ": all " + std::to_string(spec.total_frames()) + " frames (" +
                    std::to_string(spec.warmup) + " of warm-up) are done; give --frames above " +
                    std::to_string(from.frames - spec.warmup) + " to go on");
  require_recordable(spec);
  if (options.feec) spec.estimate = estimate_settings(*options.feec, spec.stepper);
  return spec;
}

}  // namespace pbmpi::app
