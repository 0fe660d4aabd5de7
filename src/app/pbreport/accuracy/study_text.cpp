#include "app/pbreport/accuracy/study_text.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/pbreport/study/error_text.h"
#include "app/pbreport/study/study_file.h"

namespace pbmpi::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 4> measure_texts = {"rms of body positions", "p99 of body positions",
                                                      "max of body positions", "rms of joint gaps"};

std::string run_command(const StudyCase& one) {
  std::string text = "mpirun -n 1 pbmpi";
  for (const auto& [name, value] : setting_options(one))
    text += format(" --%s %s", name.c_str(), value.c_str());
  return text;
}

constexpr const char* yardstick_format =
    "  %-36s defect rms %9.4g  p99 %9.4g  max %9.4g mm, drift rms %9.4g mm%s\n";

std::string yardstick_text(const char* what, const std::optional<StudyCase>& halved) {
  if (!halved) return "";
  const analysis::ErrorSummary& error = halved->defect.body_position;
  return format(yardstick_format, what, 1e3 * error.rms, 1e3 * error.p99, 1e3 * error.max,
                1e3 * halved->drift.body_position.rms, "");
}

std::string floor_text(const SceneCases& scene) {
  double drift = 0;
  for (const StudyCase& one : scene.floor) drift = std::max(drift, one.drift.body_position.rms);
  return format(yardstick_format,
                "noise floor (another solver seed):", 1e3 * scene.floor_m(ErrorMeasure::rms),
                1e3 * scene.floor_m(ErrorMeasure::p99), 1e3 * scene.floor_m(ErrorMeasure::max), 1e3 * drift,
                format(" (largest of %zu seeds)", scene.floor.size()).c_str());
}

std::string row_text(const StudyCase& one, bool at_floor) {
  const std::string remarks = remarks_text(one, at_floor);
  const analysis::ErrorSummary& error = one.defect.body_position;
  return format("  %9.3f %9.3f %10.3g  %-32s %9.4g %9.4g %9.4g %9.4g %9.4g %9s  %s%s\n", 1e3 * one.time_s,
                1e3 * one.median_time_s, one.row_visits, setting_text(one).c_str(), 1e3 * error.rms,
                1e3 * error.p99, 1e3 * error.max, 1e3 * one.joint_gap_m, 1e3 * one.drift.body_position.rms,
                std::isnan(one.rest_creep_m_s) ? "-" : format("%.3g", 1e3 * one.rest_creep_m_s).c_str(),
                bands_text(error.bands).c_str(), remarks.empty() ? "" : ("  (" + remarks + ")").c_str());
}

bool keeps(const StudyCase& one, const AccuracyReportOptions& options) {
  return options.budget_s ? one.time_s <= *options.budget_s
                          : one.error_m(options.measure) <= *options.tolerance_m;
}

std::string choice_text(const SceneCases& scene, const AccuracyReportOptions& options) {
  if (!options.budget_s && !options.tolerance_m) return "";
  const auto chosen = chosen_setting(scene, options);
  const std::string asked = options.budget_s ? format("budget %g ms", 1e3 * *options.budget_s)
                                             : format("tolerance %g mm", 1e3 * *options.tolerance_m);
  if (!chosen) {
    const bool one_that_falls = std::ranges::any_of(
        scene.settings, [&](const StudyCase& one) { return one.fells() && keeps(one, options); });
    return "  " + asked + ": no setting of the study keeps it" +
           (one_that_falls ? " without felling what stands at rest\n" : "\n");
  }
  const StudyCase& one = scene.settings[*chosen];
  return format("  %s: %s (%.3f ms, defect %.4g mm)\n  run: %s\n", asked.c_str(), setting_text(one).c_str(),
                1e3 * one.time_s, 1e3 * one.error_m(options.measure), run_command(one).c_str());
}

Json case_json(const StudyCase& one, double floor_m, const AccuracyReportOptions& options) {
  Json json;
  for (const auto& [name, value] : setting_options(one)) json["options"][name] = value;
  json["frame_time_s"] = {{"worst", one.time_s}, {"median", one.median_time_s}};
  json["row_visits"] = one.row_visits;
  json["defect"] = errors_json(one.defect);
  json["joint_gap_m"] = one.joint_gap_m;
  json["error_m"] = one.error_m(options.measure);
  json["at_noise_floor"] = one.error_m(options.measure) <= floor_m;
  if (!std::isnan(one.rest_fallen)) {
    json["at_rest"] = {
        {"fallen", one.rest_fallen},
        {"fell_at_s", std::isfinite(one.rest_fell_at_s) ? Json(one.rest_fell_at_s) : Json(nullptr)},
        {"creep_m_s", one.rest_creep_m_s},
        {"energy_gain_j", one.rest_energy_gain_j}};
  }
  return json;
}

std::string scene_text(const SceneCases& scene, const AccuracyReportOptions& options) {
  std::string text = "\nscene: " + scene.name + "\n" + floor_text(scene) +
                     yardstick_text("reference with half the iterations:", scene.halved_iterations) +
                     yardstick_text("reference with half the substeps:", scene.halved_substeps) +
                     yardstick_text("reference with half the step:", scene.halved_dt);
  text += format("  Pareto front of %zu settings\n  %9s %9s %10s  %-32s %9s %9s %9s %9s %9s %9s  %s\n",
                 scene.settings.size(), "worst ms", "median ms", "row visits",
                 "setting (substeps x iterations)", "rms mm", "p99 mm", "max mm", "gap mm", "drift mm",
                 "creep mm/s", "bodies < 1 cm/1-10/10-100/> 100/inf");
  const double floor = scene.floor_m(options.measure);
  for (const std::size_t i : scene.pareto_front(options.measure)) {
    text += row_text(scene.settings[i], scene.settings[i].error_m(options.measure) <= floor);
  }
  if (!scene.estimates.empty()) {
    text +=
        "  estimates (FEEC): times are those until a look into the frame's last solve, after so many of its "
        "iterations\n";
  }
  for (const StudyCase& one : scene.estimates) text += row_text(one, one.error_m(options.measure) <= floor);
  return text + choice_text(scene, options);
}

}  // namespace

std::string remarks_text(const StudyCase& one, bool at_floor) {
  std::string text;
  if (one.fells()) {
    text = format("fells %.0f %s at rest, the first after %.3g s", one.rest_fallen,
                  one.rest_fallen > 1 ? "bodies" : "body", one.rest_fell_at_s);
  }
  if (at_floor) text += text.empty() ? "at the noise floor" : "; at the noise floor";
  return text;
}

std::optional<std::size_t> chosen_setting(const SceneCases& scene, const AccuracyReportOptions& options) {
  if (options.budget_s) return scene.best_within(*options.budget_s, options.measure);
  if (options.tolerance_m) return scene.cheapest_within(*options.tolerance_m, options.measure);
  return std::nullopt;
}

std::string study_to_text(const io::TableFile& file, const std::vector<SceneCases>& scenes,
                          const AccuracyReportOptions& options) {
  std::string text = format(
      "study: accuracy; defect after one frame from the reference's state, ranked by the %s\n"
      "reference: sor double, %s x %s (substeps x iterations), solver seed %s\n",
      measure_texts[static_cast<std::size_t>(options.measure)],
      text_parameter(file, "reference_substeps", "?").c_str(),
      text_parameter(file, "reference_iterations", "?").c_str(), text_parameter(file, "seed", "?").c_str());
  for (const SceneCases& scene : scenes) text += scene_text(scene, options);
  return text;
}

std::string study_to_json(const std::vector<SceneCases>& scenes, const AccuracyReportOptions& options) {
  Json json;
  json["scenes"] = Json::array();
  for (const SceneCases& scene : scenes) {
    const double floor_m = scene.floor_m(options.measure);
    Json one;
    one["scene"] = scene.name;
    one["noise_floor_m"] = floor_m;
    for (const auto& [name, halved] : {std::pair("halved_iterations_m", &scene.halved_iterations),
                                       std::pair("halved_substeps_m", &scene.halved_substeps),
                                       std::pair("halved_dt_m", &scene.halved_dt)}) {
      if (*halved) one[name] = (*halved)->error_m(options.measure);
    }
    one["front"] = Json::array();
    for (const std::size_t i : scene.pareto_front(options.measure)) {
      one["front"].push_back(case_json(scene.settings[i], floor_m, options));
    }
    for (const StudyCase& estimate : scene.estimates) {
      one["estimates"].push_back(case_json(estimate, floor_m, options));
      one["estimates"].back()["look_after_iterations"] = estimate.estimate_iterations;
    }
    const auto chosen = chosen_setting(scene, options);
    if (chosen) one["chosen"] = case_json(scene.settings[*chosen], floor_m, options);
    if (chosen) one["run"] = run_command(scene.settings[*chosen]);
    json["scenes"].push_back(one);
  }
  return json_text(json, 2) + "\n";
}

std::string preset_text(const StudyCase& one) {
  std::string text =
      format("# %s: frame time %.3f ms, defect rms %.4g mm, max %.4g mm\n", setting_text(one).c_str(),
             1e3 * one.time_s, 1e3 * one.defect.body_position.rms, 1e3 * one.defect.body_position.max);
  for (const auto& [name, value] : setting_options(one))
    text += format("%s = %s\n", name.c_str(), value.c_str());
  return text;
}

}  // namespace pbmpi::app
