#include "app/pbstudy/prediction/child_runs.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "core/error.h"
#include "io/file/write_file.h"

namespace pbmpi::app {
namespace {

namespace fs = std::filesystem;

std::string program(const std::string& name) { return core::folder_of_program() + "/" + name; }

std::string read(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string new_folder() {
  std::string path = (fs::temp_directory_path() / "pbmpi-prediction-XXXXXX").string();
  if (mkdtemp(path.data()) == nullptr)
    throw core::RunError(path +
                         ": the folder cannot be made; is TMPDIR a folder in which files can be made?");
  return path;
}

/// The scene as a file under its own name, on which hashes and random numbers depend.
std::string scene_file(const ChildRuns& runs, const StudyScene& scene) {
  std::string name = scene.source.name;
  std::ranges::replace(name, '/', '_');
  std::string path = runs.file(name + ".toml");
  if (!fs::exists(path)) io::write_file(path, scene.source.text);
  return path;
}

}  // namespace

std::string tool_folder() { return fs::path(core::folder_of_program()).parent_path() / "lib" / "pbvalue"; }

bool has_program(const std::string& name) { return fs::exists(program(name)); }

int ChildRun::nonfinite_frame() const {
  static const std::regex pattern("non-finite bod(?:y|ies) in frame ([0-9]+)");
  std::smatch match;
  return std::regex_search(errors, match, pattern) ? std::stoi(match[1]) : -1;
}

void require_end(const ChildRun& run, const std::string& what) {
  if (!run.end.timed_out && !run.has_ended_well())
    throw core::RunError(what + " ended with exit code " + std::to_string(run.end.exit_code) + ":\n" +
                         run.errors);
}

ChildRuns::ChildRuns(double time_limit_s) : folder_(new_folder()), time_limit_s_(time_limit_s) {}

ChildRuns::~ChildRuns() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

ChildRun ChildRuns::simulate(const std::string& name, const PredictionCase& one, const StudyScene& scene,
                             std::vector<std::string> before, const std::vector<std::string>& more,
                             int steps_per_frame) {
  const int scene_steps = scene.steps_per_frame();
  const int steps = steps_per_frame > 0 ? steps_per_frame : scene_steps;
  core::Child child;
  child.command = std::move(before);
  const std::vector<std::string> own = {program(one.program),
                                        "--scene",
                                        scene_file(*this, scene),
                                        "--stepper",
                                        one.stepper,
                                        "--warmup",
                                        "0",
                                        "--frames",
                                        std::to_string(scene.total_frames() * scene_steps / steps),
                                        "--steps-per-frame",
                                        std::to_string(steps),
                                        "--replicas",
                                        std::to_string(scene.num_worlds),
                                        "--output",
                                        file(name + ".h5"),
                                        "--report",
                                        "json",
                                        "--progress",
                                        "never"};
  child.command.insert(child.command.end(), own.begin(), own.end());
  child.command.insert(child.command.end(), more.begin(), more.end());
  return start(name, child);
}

ChildRun ChildRuns::difference(const std::string& file, const std::string& reference) {
  core::Child child;
  child.command = {program("pbreport"), "diff", file, reference, "--json"};
  return start("diff", child);
}

ChildRun ChildRuns::start(const std::string& name, core::Child& child) {
  child.environment = {{"VALGRIND_LIB", tool_folder()}};
  child.output_file = file(name + ".json");
  child.error_file = file(name + ".err");
  child.time_limit_s = time_limit_s_;
  ChildRun run{core::run_child(child), {}, {}};
  run.errors = read(child.error_file);
  run.summary = nlohmann::json::parse(read(child.output_file), nullptr, false);
  if (run.summary.is_discarded()) run.summary = nullptr;
  return run;
}

}  // namespace pbmpi::app
