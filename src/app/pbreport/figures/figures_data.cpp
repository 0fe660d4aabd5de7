#include "app/pbreport/figures/figures_data.h"

#include <algorithm>
#include <map>

#include "app/pbreport/diff/run_comparison.h"
#include "core/error.h"
#include "core/text.h"
#include "stepping/frame_budget.h"
#include "stepping/names.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

constexpr const char* reference_label = "Iter20";
constexpr const char* floor_label = "seed";

struct Recorded {
  std::string path;
  std::string scene, label;
  io::RunData run;
};

/// Stepper and precision that the file stores under this prefix.
stepping::StepperSettings step_settings(const io::RunData& run, const std::string& prefix) {
  stepping::StepperSettings settings;
  for (const char* name : {"stepper", "precision"}) {
    const stepping::StepOption& option = stepping::step_option(name);
    const std::string in_file = prefix + file_name(option);
    const std::string text = core::value_in(run.parameters, in_file);
    if (!text.empty()) set(option, text, "parameter " + in_file, settings);
  }
  return settings;
}

std::string label_of(const io::RunData& run) {
  if (core::value_in(run.parameters, "feec") == "1") {
    return "FEEC " + stepper_text(step_settings(run, "estimate_")) + " x " +
           core::value_in(run.parameters, "estimate_iterations");
  }
  if (core::value_in(run.parameters, "solver_seed") != core::value_in(run.parameters, "seed"))
    return floor_label;
  const stepping::StepperKind kind = step_settings(run, "").kind;
  const std::string paper_label = "Iter";  // the paper has quick alone
  return (kind == stepping::StepperKind::quick ? paper_label : std::string(name_of(kind)) + " x ") +
         core::value_in(run.parameters, "iterations");
}

Recorded read(const std::string& path) {
  Recorded recorded{path, "", "", io::read_run(path)};
  recorded.scene = core::value_in(recorded.run.parameters, "scene");
  recorded.label = label_of(recorded.run);
  return recorded;
}

/// Times of the measured frames of one run: of the precise result, or of an estimate's delivery.
std::vector<double> frame_times(const io::RunData& run, bool is_estimate) {
  const std::vector<double>& all = is_estimate ? run.estimate.delivered_s : run.frame_wall_s;
  std::vector<double> measured;
  for (std::size_t frame = 0; frame < all.size(); ++frame) {
    if (run.frame_measured[frame]) measured.push_back(all[frame]);
  }
  return measured;
}

/// Frame by frame the least time of the repeats: other programs on the machine only add time, to some runs
/// and not to others.
void fill_times(const std::vector<const Recorded*>& runs, FigureMethod& method) {
  std::vector<std::vector<double>> by_frame;
  for (const Recorded* run : runs) {
    const std::vector<double> times = frame_times(run->run, method.is_estimate);
    by_frame.resize(std::max(by_frame.size(), times.size()));
    for (std::size_t frame = 0; frame < times.size(); ++frame) by_frame[frame].push_back(times[frame]);
  }
  if (by_frame.empty()) return;
  double sum = 0, satisfied = 0;
  for (const std::vector<double>& repeats : by_frame) {
    const double time_s = *std::min_element(repeats.begin(), repeats.end());
    sum += time_s;
    satisfied += time_s <= stepping::default_frame_budget_s ? 1 : 0;
  }
  const auto num_frames = static_cast<double>(by_frame.size());
  method.mean_frame_s = sum / num_frames;
  method.frame_rate_hz = num_frames / sum;
  method.satisfied_fraction = satisfied / num_frames;
}

/// Stretch of the human segments in the poses that consumers see.
std::vector<double> measured_stretch(const RunModels& models, const io::RunData& run, bool is_estimate) {
  std::vector<double> all;
  const auto& positions = is_estimate ? run.estimate.position : run.position;
  const auto& orientations = is_estimate ? run.estimate.orientation : run.orientation;
  for (const std::size_t row : measured_rows(run, positions.size())) {
    const std::vector<double> one =
        recorded_stretch(models, {&positions[row], &orientations[row], broken_at(models, run, row)});
    all.insert(all.end(), one.begin(), one.end());
  }
  return all;
}

FigureMethod make_method(const std::string& label, const std::vector<const Recorded*>& runs,
                         const RunModels& models, const Recorded& reference) {
  FigureMethod method;
  method.label = label;
  method.num_runs = static_cast<int>(runs.size());
  method.is_estimate = !runs.front()->run.estimate.position.empty();
  for (const Recorded* run : runs) require_comparable(run->run, run->path, reference.run, reference.path);
  fill_times(runs, method);
  const RunComparison comparison = compare_runs(models, runs.front()->run, reference.run, {});
  method.errors = method.is_estimate ? *comparison.estimate_drift : comparison.drift;
  method.stretch = measured_stretch(models, runs.front()->run, method.is_estimate);
  method.max_joint_gap_m = comparison.run.max_joint_gap_m;
  method.same_hash =
      runs.front()->run.attributes.at("state_hash") == reference.run.attributes.at("state_hash");
  return method;
}

FigureScene make_scene(const std::string& name, const std::vector<const Recorded*>& runs) {
  std::vector<std::pair<std::string, std::vector<const Recorded*>>> methods;
  for (const Recorded* run : runs) {
    auto method =
        std::find_if(methods.begin(), methods.end(), [&](const auto& m) { return m.first == run->label; });
    if (method == methods.end()) method = methods.insert(methods.end(), {run->label, {}});
    method->second.push_back(run);
  }
  const auto first =
      std::find_if(methods.begin(), methods.end(), [](const auto& m) { return m.first == reference_label; });
  core::require_input(first != methods.end(),
                      name +
                          ": no file has a run of quick with 20 iterations, which the "
                          "others are held against; record one");
  std::rotate(methods.begin(), first, first + 1);
  const Recorded& reference = *methods.front().second.front();
  const RunModels models = rebuild_models(reference.run, reference.path);
  FigureScene scene{name, {}, {}};
  for (const auto& [label, of_label] : methods) {
    if (label != floor_label) {
      scene.methods.push_back(make_method(label, of_label, models, reference));
      continue;
    }
    for (const Recorded* run : of_label) {
      scene.floor.push_back(make_method(label, {run}, models, reference).errors);
    }
  }
  return scene;
}

}  // namespace

const FigureMethod* FigureScene::find(const std::string& label) const {
  const auto found =
      std::find_if(methods.begin(), methods.end(), [&](const FigureMethod& m) { return m.label == label; });
  return found == methods.end() ? nullptr : &*found;
}

RecordedFigures recorded_figures(const std::vector<std::string>& paths) {
  RecordedFigures found;
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::string>> by_scene;  // runs of one scene at a time are in memory
  for (const std::string& path : paths) {
    const io::RunData run = io::read_run(path);
    const std::string name = core::value_in(run.parameters, "scene");
    found.files.emplace_back(path, run.attributes);
    if (!by_scene.contains(name)) names.push_back(name);
    by_scene[name].push_back(path);
  }
  for (const std::string& name : names) {
    std::vector<Recorded> runs;
    for (const std::string& path : by_scene[name]) runs.push_back(read(path));
    std::vector<const Recorded*> pointers;
    pointers.reserve(runs.size());
    for (const Recorded& run : runs) pointers.push_back(&run);
    found.scenes.push_back(make_scene(name, pointers));
  }
  return found;
}

}  // namespace pbmpi::app
