#include "app/pbreport/accuracy/diagrams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/pbreport/accuracy/study_text.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

using ChartJson = nlohmann::json;

/// Colours that people with any colour vision can tell apart: Okabe and Ito, "Color Universal Design" (2008).
/// In the order of StepperKind.
constexpr std::array<const char*, 5> engine_colours = {"#0072b2", "#cc79a7", "#e69f00", "#d55e00", "#56b4e9"};

std::string setting_colour(const stepping::StepperSettings& settings) {
  constexpr const char* single = "#009e73";
  return settings.precision == stepping::Precision::single ? single : engine_colour(settings.kind);
}

/// "2 substeps of 20 iterations": explains "2 x 20".
std::string sweeps_text(const StudyCase& one) {
  const auto counted = [](int count, const char* noun) {
    return format("%d %s%s", count, noun, count == 1 ? "" : "s");
  };
  if (!stepping::traits_of(one.stepper.kind).iterates) return "";
  return " (" + counted(one.stepper.substeps, "substep") + " of " +
         counted(one.stepper.iterations, "iteration") + ")";
}

ChartJson point(const StudyCase& one, double y_mm) {
  return {
      {"x", 1e3 * one.time_s},
      {"y", y_mm},
      {"label", setting_text(one) + sweeps_text(one) + format(": %.3f ms, %.4g mm", 1e3 * one.time_s, y_mm)}};
}

/// Shapes of points by number of substeps, the fewest first; if there are more numbers than shapes, the rest
/// share the last.
constexpr std::array<const char*, 5> shapes = {"circle", "triangle", "rect", "rectRot", "star"};

/// The numbers of substeps in the study, ascending, and the most iterations.
struct SweepScale {
  std::vector<int> substeps;
  int most_iterations = 1;

  explicit SweepScale(const SceneCases& scene) {
    for (const StudyCase& one : scene.settings) {
      substeps.push_back(one.stepper.substeps);
      most_iterations = std::max(most_iterations, one.stepper.iterations);
    }
    std::ranges::sort(substeps);
    substeps.erase(std::unique(substeps.begin(), substeps.end()), substeps.end());
  }
  const char* shape(int count) const {
    const auto place = static_cast<std::size_t>(std::ranges::lower_bound(substeps, count) - substeps.begin());
    return shapes[std::min(place, shapes.size() - 1)];
  }
  /// Radius in pixels: 3 for one iteration, 6.5 for the most, linear in the logarithm in between.
  double radius(int iterations) const {
    const double share = std::log2(std::max(1, iterations)) / std::max(1.0, std::log2(most_iterations));
    return 3 + 3.5 * share;
  }
  ChartJson key() const {
    ChartJson entries = ChartJson::array();
    for (std::size_t i = 0; i < substeps.size(); ++i) {
      if (i >= shapes.size()) break;
      const bool is_last = i + 1 == shapes.size() && substeps.size() > shapes.size();
      const char* noun = substeps[i] == 1 ? "substep" : "substeps";
      entries.push_back(
          {{"label", format("%d %s%s", substeps[i], noun, is_last ? " or more" : "")}, {"shape", shapes[i]}});
    }
    entries.push_back({{"label", "1 iteration"}, {"shape", "circle"}, {"radius", radius(1)}});
    if (most_iterations > 1)
      entries.push_back({{"label", format("%d iterations", most_iterations)},
                         {"shape", "circle"},
                         {"radius", radius(most_iterations)}});
    return entries;
  }
};

ChartJson line(double value, const char* axis, const char* label, const char* colour, const ChartJson& dash) {
  return {{"from", value},  {"to", value},      {"axis", axis},
          {"label", label}, {"colour", colour}, {"dash", dash}};
}

/// The uncertainty of the reference, with the cases that bound it, and the limits asked for. `ranked`: the
/// diagram shows the error by which settings are ranked.
ChartJson bands_of(const SceneCases& scene, ErrorOf error_mm, bool ranked,
                   const AccuracyReportOptions& options) {
  double floor = 0;
  for (const StudyCase& one : scene.floor) floor = std::max(floor, error_mm(one));
  ChartJson bands = {{{"from", 0},
                      {"to", scene.uncertainty(error_mm)},
                      {"label", "uncertainty of the reference [mm]"},
                      {"colour", "rgba(120, 130, 142, .30)"}},
                     line(floor, "y", "another solver seed: noise floor [mm]", "#7a8490", {1, 3})};
  const auto add_line = [&](const std::optional<StudyCase>& found, const char* label, const ChartJson& dash) {
    if (found) bands.push_back(line(error_mm(*found), "y", label, "#7a8490", dash));
  };
  add_line(scene.more_iterations, "reference with more iterations [mm]", ChartJson::array());
  add_line(scene.second_method, "second method: ODE [mm]", {4, 2, 1, 2});
  add_line(scene.halved_iterations, "reference with half the iterations [mm]", ChartJson::array());
  add_line(scene.halved_substeps, "reference with half the substeps [mm]", {2, 3});
  add_line(scene.halved_dt, "reference with half the step [mm]", {8, 4});
  if (options.budget_s) bands.push_back(line(1e3 * *options.budget_s, "x", "budget [ms]", "#d55e00", {6, 4}));
  if (options.tolerance_m && ranked)
    bands.push_back(line(1e3 * *options.tolerance_m, "y", "tolerance [mm]", "#d55e00", {6, 4}));
  return bands;
}

/// A set of points for each stepper: the shape shows the number of substeps, the size the number of
/// iterations.
ChartJson setting_sets(const SceneCases& scene, ErrorOf error_mm, const SweepScale& scale) {
  struct Points {
    std::string colour;
    ChartJson data = ChartJson::array(), shape = ChartJson::array(), radius = ChartJson::array();
  };
  std::map<std::string, Points> by_stepper;
  for (const StudyCase& one : scene.settings) {
    if (!one.finite()) continue;
    Points& points = by_stepper[stepper_text(one.stepper)];
    points.colour = setting_colour(one.stepper);
    points.data.push_back(point(one, error_mm(one)));
    points.shape.push_back(scale.shape(one.stepper.substeps));
    points.radius.push_back(scale.radius(one.stepper.iterations));
  }
  ChartJson sets = ChartJson::array();
  for (const auto& [stepper, points] : by_stepper) {
    sets.push_back({{"label", stepper},
                    {"data", points.data},
                    {"backgroundColor", points.colour},
                    {"keyShape", "bar"},
                    {"pointStyle", points.shape},
                    {"pointRadius", points.radius}});
  }
  return sets;
}

ChartJson front_set(const SceneCases& scene, ErrorOf error_mm) {
  ChartJson front = ChartJson::array();
  for (const std::size_t i : scene.pareto_front(error_mm))
    front.push_back(point(scene.settings[i], error_mm(scene.settings[i])));
  return {{"label", "Pareto front"}, {"data", front},    {"showLine", true}, {"borderColor", "#3d4650"},
          {"borderWidth", 1.5},      {"pointRadius", 0}, {"unread", true},   {"pointHitRadius", 0}};
}

/// A ring round the chosen setting; none if no choice was asked for, or no setting keeps the limits.
std::optional<ChartJson> chosen_set(const SceneCases& scene, ErrorOf error_mm,
                                    const AccuracyReportOptions& options) {
  const auto chosen = chosen_setting(scene, options);
  if (!chosen) return std::nullopt;
  const StudyCase& one = scene.settings[*chosen];
  ChartJson where = point(one, error_mm(one));
  where["label"] = "chosen: " + where["label"].get<std::string>();
  return ChartJson{{"label", "chosen"},        {"data", ChartJson::array({where})},
                   {"borderColor", "#d55e00"}, {"backgroundColor", "transparent"},
                   {"borderWidth", 2.5},       {"pointRadius", 10},
                   {"keyShape", "ring"},       {"unread", true}};
}

/// FEEC's looks into the frame's last solve.
std::optional<ChartJson> estimate_set(const SceneCases& scene, ErrorOf error_mm) {
  ChartJson points = ChartJson::array();
  for (const StudyCase& one : scene.estimates) {
    if (one.finite()) points.push_back(point(one, error_mm(one)));
  }
  if (points.empty()) return std::nullopt;
  return ChartJson{{"label", "estimates (FEEC)"}, {"data", points},   {"borderColor", "#56b4e9"},
                   {"pointStyle", "crossRot"},    {"pointRadius", 5}, {"borderWidth", 2.2}};
}

}  // namespace

std::string engine_colour(stepping::StepperKind kind) {
  return engine_colours[static_cast<std::size_t>(kind)];
}

io::html::Chart diagram(const SceneCases& scene, const AccuracyReportOptions& options, const char* title,
                        const char* axis, ErrorOf error_mm, ErrorMeasure measure) {
  const SweepScale scale(scene);
  ChartJson datasets = setting_sets(scene, error_mm, scale);
  datasets.insert(datasets.begin(), front_set(scene, error_mm));
  if (auto estimates = estimate_set(scene, error_mm)) datasets.push_back(std::move(*estimates));
  if (auto chosen = chosen_set(scene, error_mm, options)) datasets.push_back(std::move(*chosen));
  const auto axis_of = [](const std::string& text) {
    return ChartJson{{"type", "logarithmic"}, {"title", {{"display", true}, {"text", text}}}};
  };
  const ChartJson marks = {{"bands", bands_of(scene, error_mm, measure == options.measure, options)},
                           {"key", scale.key()}};
  const ChartJson config = {
      {"type", "scatter"},
      {"data", {{"datasets", datasets}}},
      {"options",
       {{"scales", {{"x", axis_of("time of the worst frame [ms]")}, {"y", axis_of(axis)}}},
        {"plugins", {{"pbmpi", marks}}}}}};
  return {title, "Each point is a setting; down and left is better.", json_text(config)};
}

}  // namespace pbmpi::app
