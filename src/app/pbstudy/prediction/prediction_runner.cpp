#include "app/pbstudy/prediction/prediction_runner.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "app/common/format.h"
#include "core/error.h"
#include "core/system/child.h"
#include "io/file/write_file.h"

namespace pbmpi::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A folder that goes with its owner.
class Folder {
 public:
  Folder() {
    std::string path = (fs::temp_directory_path() / "pbmpi-prediction-XXXXXX").string();
    if (mkdtemp(path.data()) == nullptr) throw core::RunError(path + ": the folder cannot be made");
    path_ = path;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string program(const char* name) { return core::folder_of_program() + "/" + name; }
std::string tool_folder() { return fs::path(core::folder_of_program()).parent_path() / "lib" / "pbvalue"; }

std::string read(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A run of pbmpi. Its files lie in the folder, under its name.
struct Run {
  core::ChildEnd end;
  std::string errors;
  json summary;  ///< null if it wrote none
};

class Runner {
 public:
  Runner(const PredictionCase& one, const StudyScene& scene, const PredictionOptions& options)
      : case_(one), scene_(scene), options_(options) {
    std::string name = scene.source.name;
    std::ranges::replace(name, '/', '_');
    scene_file_ = folder_ / (name + ".toml");
    io::write_file(scene_file_, scene.source.text);
  }

  std::string file(const std::string& name) const { return folder_ / name; }

  /// `before`: the command that pbmpi follows, or none. `steps_per_frame`: others than the scene's.
  Run run(const std::string& name, std::vector<std::string> before, const std::vector<std::string>& more,
          int steps_per_frame = 0) {
    core::Child child;
    child.command = std::move(before);
    const int scene_steps = scene_.steps_per_frame();
    const int steps = steps_per_frame > 0 ? steps_per_frame : scene_steps;
    for (const std::string& word : {program("pbmpi"),
                                    std::string("--scene"),
                                    scene_file_,
                                    std::string("--stepper"),
                                    case_.stepper,
                                    std::string("--warmup"),
                                    std::string("0"),
                                    std::string("--frames"),
                                    std::to_string(scene_.total_frames() * scene_steps / steps),
                                    std::string("--steps-per-frame"),
                                    std::to_string(steps),
                                    std::string("--replicas"),
                                    std::to_string(scene_.num_worlds),
                                    std::string("--seed"),
                                    std::to_string(options_.seed),
                                    std::string("--output"),
                                    file(name + ".h5"),
                                    std::string("--no-xdmf"),
                                    std::string("--report"),
                                    std::string("json"),
                                    std::string("--progress"),
                                    std::string("never")})
      child.command.push_back(word);
    child.command.insert(child.command.end(), more.begin(), more.end());
    return started(name, child);
  }

  Run started(const std::string& name, core::Child& child) {
    child.environment = {{"VALGRIND_LIB", tool_folder()}};
    child.output_file = file(name + ".json");
    child.error_file = file(name + ".err");
    child.time_limit_s = options_.time_limit_s;
    Run run{core::run_child(child), {}, {}};
    run.errors = read(child.error_file);
    run.summary = json::parse(read(child.output_file), nullptr, false);
    if (run.summary.is_discarded()) run.summary = nullptr;
    return run;
  }

  std::vector<std::string> tool(bool has_cycles) const {
    std::vector<std::string> command = {"valgrind", "--quiet", "--tool=pbvalue",
                                        "--pbvalue-out-file=" + file("tool.json"), "--scope=" + case_.scope};
    if (case_.threshold > 0) command.push_back(format("--threshold=%.17g", case_.threshold));
    command.insert(command.end(), options_.tool_options.begin(), options_.tool_options.end());
    if (has_cycles && case_.has_cycles) add_models(command);
    return command;
  }

  std::vector<std::string> step_options(bool with_case) const {
    std::vector<std::string> words;
    if (case_.stepper == "quick") {
      const int iterations = with_case ? case_.iterations : scene_.iterations;
      words = {"--iterations", std::to_string(iterations)};
    }
    if (with_case && case_.feec) words.emplace_back("--feec");
    return words;
  }

 private:
  void add_models(std::vector<std::string>& command) const {
    command.push_back(format("--first-modelled=%d", scene_.warmup));
    command.emplace_back(case_.feec ? "--modelled=estimate" : "--modelled=precise");
    command.emplace_back("--model=none");
    command.emplace_back("--model=predicted:predict=1");
    if (!case_.has_variants) return;
    for (std::size_t i = 1; i < model_variants().size(); ++i) {
      const std::string settings = model_variants()[i].settings;
      command.push_back(format("--model=none%zu:", i) + settings);
      command.push_back(format("--model=predicted%zu:", i) + settings + ",predict=1");
    }
  }

  const PredictionCase& case_;
  const StudyScene& scene_;
  const PredictionOptions& options_;
  Folder folder_;
  std::string scene_file_;
};

PredictedFrame frame_from(const json& section, bool is_estimate) {
  PredictedFrame frame;
  frame.is_estimate = is_estimate ? 1 : 0;
  frame.instructions = section.at("instructions");
  frame.collision_instructions = section.at("collision_instructions");
  for (std::size_t i = 0; i < mix_classes.size(); ++i) frame.mix[i] = section.at("mix").at(mix_classes[i]);
  for (std::size_t i = 0; i < value_classes.size(); ++i) {
    const json& numbers = section.at("classes").at(value_classes[i]);
    frame.hits[i] = {numbers.at("executed"), numbers.at("repeated"), numbers.at("exact"),
                     numbers.at("fuzzy"),    numbers.at("wrong"),    numbers.at("error_sum"),
                     numbers.at("error_max")};
  }
  if (section.at("modelled").get<bool>()) {
    frame.micro_ops = section.at("micro_ops");
    frame.cycles = section.at("cycles").at("none");
    frame.predicted_cycles = section.at("cycles").at("predicted");
  }
  return frame;
}

void read_tool(const json& report, const PredictionCase& one, int case_index, PredictionOutcome& outcome) {
  std::array<int, 2> seen{};
  std::vector<VariantCycles> variants(one.has_variants ? model_variants().size() : 0);
  for (std::size_t i = 0; i < variants.size(); ++i)
    variants[i] = {case_index, static_cast<std::int32_t>(i), 0, 0};
  for (const json& section : report.at("sections")) {
    const bool is_estimate = section.at("section") == "estimate";
    PredictedFrame frame = frame_from(section, is_estimate);
    frame.case_index = case_index;
    frame.frame = seen[is_estimate ? 1 : 0]++;
    outcome.frames.push_back(frame);
    for (std::size_t i = 0; i < variants.size() && frame.cycles >= 0; ++i) {
      const std::string suffix = i == 0 ? "" : std::to_string(i);
      variants[i].cycles += section.at("cycles").at("none" + suffix).get<std::int64_t>();
      variants[i].predicted_cycles += section.at("cycles").at("predicted" + suffix).get<std::int64_t>();
    }
  }
  outcome.result.num_frames = seen[0];
  outcome.variants = variants;
}

/// The frame of "... non-finite body in frame 3"; -1 if there is none.
int nonfinite_frame(const std::string& errors) {
  static const std::regex pattern("non-finite bod(?:y|ies) in frame ([0-9]+)");
  std::smatch match;
  return std::regex_search(errors, match, pattern) ? std::stoi(match[1]) : -1;
}

/// All frames, or up to one with a number that is not finite.
bool has_ended_well(const Run& run) {
  return run.end.exit_code == 0 || (run.end.exit_code == 1 && nonfinite_frame(run.errors) >= 0);
}

void require_end(const Run& run, const std::string& what) {
  if (!run.end.timed_out && !has_ended_well(run))
    throw core::RunError(what + " ended with exit code " + std::to_string(run.end.exit_code) + ":\n" +
                         run.errors);
}

/// The bands and sizes of `tables` as one; no p99, which their p99 do not give. The rms is over entries that
/// have a finite error, as in each table.
analysis::ErrorTable joined(const json& tables, std::size_t first, std::size_t last) {
  analysis::ErrorTable all;
  for (const analysis::NamedSummary& named : analysis::error_columns) {
    analysis::ErrorSummary& sum = all.*named.summary;
    sum = {};
    std::int64_t num_finite = 0;
    double squares = 0;
    for (std::size_t i = first; i < std::min(last, tables.size()); ++i) {
      const json& one = tables[i].at(std::string(named.name) + "_" + named.unit);
      const auto real = [&](const char* key) {
        return one.at(key).is_null() ? INFINITY : one.at(key).get<double>();
      };
      const auto count = one.at("count").get<std::int64_t>(), broken = one.at("broken").get<std::int64_t>();
      const std::int64_t finite = count - broken - one.at("bands").back().get<std::int64_t>();
      sum.count += count;
      sum.broken += broken;
      num_finite += finite;
      if (finite > 0) squares += static_cast<double>(finite) * real("rms") * real("rms");
      sum.max = std::max(sum.max, real("max"));
      for (std::size_t band = 0; band < sum.bands.size(); ++band)
        sum.bands[band] += one.at("bands")[band].get<std::int64_t>();
    }
    sum.rms = num_finite > 0 ? std::sqrt(squares / static_cast<double>(num_finite)) : 0;
    sum.p99 = NAN;
  }
  return all;
}

/// "pbreport diff" of two runs that lie in the folder; null if nothing can be compared.
json difference(Runner& runner, const std::string& run, const std::string& reference) {
  core::Child child;
  child.command = {program("pbreport"), "diff", runner.file(run + ".h5"), runner.file(reference + ".h5"),
                   "--json"};
  return runner.started("diff", child).summary;
}

void compare(Runner& runner, const PredictionCase& one, const StudyScene& scene, PredictionResult& result) {
  const auto warmup = static_cast<std::size_t>(scene.warmup);
  constexpr std::size_t all = static_cast<std::size_t>(-1);
  const json found = difference(runner, "run", "base");
  if (found.is_null()) return;
  result.errors_known = 1;
  result.same_hash = found.at("same_state_hash").get<bool>() ? 1 : 0;
  result.defect = joined(found.at("drift_by_frame"), 0, 1);
  result.drift = joined(found.at("drift_by_frame"), warmup, all);
  if (one.feec && found.contains("estimate_drift"))
    result.drift = joined(json::array({found.at("estimate_drift")}), 0, 1);
  const json floor = difference(runner, "floor", "base");
  if (!floor.is_null()) result.floor = joined(floor.at("drift_by_frame"), warmup, all);
}

double islands(const json& summary, const char* which) {
  return summary.is_null() || !summary.contains("islands") ? NAN
                                                           : summary.at("islands").at(which).get<double>();
}

/// A run of one step a frame tells the step from the frame.
int find_step(Runner& runner) {
  std::vector<std::string> options = runner.step_options(true);
  std::erase(options, "--feec");
  const Run run = runner.run("steps", runner.tool(false), options, 1);
  return has_ended_well(run) ? nonfinite_frame(run.errors) : -1;
}

}  // namespace

void require_tool() {
  core::require_input(fs::exists(tool_folder() + "/pbvalue-amd64-linux"),
                      "this build has no Valgrind tool pbvalue (" + tool_folder() +
                          "); install Debian's valgrind, and configure and build again");
}

PredictionOutcome run_prediction_case(const PredictionCase& one, const StudyScene& scene,
                                      const PredictionOptions& options, int case_index) {
  Runner runner(one, scene, options);
  const std::string what = scene.source.name + ", " + one.name;
  const Run base = runner.run("base", {}, runner.step_options(false));
  require_end(base, what + ": the unpredicted run");
  std::vector<std::string> other_seed = runner.step_options(false);
  other_seed.insert(other_seed.end(), {"--solver-seed", std::to_string(options.seed + 1)});
  require_end(runner.run("floor", {}, other_seed), what + ": the run of another seed");

  PredictionOutcome outcome;
  PredictionResult& result = outcome.result;
  const Run run = runner.run("run", runner.tool(true), runner.step_options(true));
  result.exit_code = run.end.timed_out ? -1 : run.end.exit_code;
  if (one.threshold == 0) require_end(run, what);  // fuzzy values may well crash the program
  result.ended = !run.end.timed_out && has_ended_well(run) ? 1 : 0;
  if (result.ended == 0) return outcome;
  const json report = json::parse(read(runner.file("tool.json")), nullptr, false);
  if (report.is_discarded()) throw core::RunError(what + ": pbvalue wrote no report\n" + run.errors);
  read_tool(report, one, case_index, outcome);
  result.islands_mean = islands(run.summary, "mean");
  result.islands_max = islands(run.summary, "max");
  result.base_islands_mean = islands(base.summary, "mean");
  compare(runner, one, scene, result);
  result.nonfinite_frame = nonfinite_frame(run.errors);
  if (result.nonfinite_frame >= 0) result.nonfinite_step = find_step(runner);
  return outcome;
}

}  // namespace pbmpi::app
