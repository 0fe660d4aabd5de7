#include "app/pbreport/accuracy/study_text.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/pbreport/study/error_text.h"
#include "app/pbreport/study/study_file.h"
#include "stepping/names.h"
#include "stepping/step_options.h"

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

/// "name   defect rms 1 p99 2 max 3 mm", the numbers in metres.
std::string defect_line(const std::string& name, double rms_m, double p99_m, double max_m) {
  return format("  %-36s defect rms %9.4g  p99 %9.4g  max %9.4g mm", name.c_str(), 1e3 * rms_m, 1e3 * p99_m,
                1e3 * max_m);
}

std::string yardstick_text(const std::string& what, const std::optional<StudyCase>& found) {
  if (!found) return "";
  const analysis::ErrorSummary& error = found->defect.body_position;
  const analysis::ErrorSummary& drift = found->drift.body_position;
  const std::string residual =
      std::isnan(found->solve_residual_m) ? "" : format(", residual %.3g mm", 1e3 * found->solve_residual_m);
  return defect_line(what, error.rms, error.p99, error.max) +
         (drift.count > 0 ? format(", drift rms %9.4g mm", 1e3 * drift.rms) : "") + residual + "\n";
}

std::string number_or_dash(double value) {
  return std::isfinite(value) ? format("%.4g", value) : std::string("-");
}

std::string floor_text(const SceneCases& scene) {
  double drift = 0;
  for (const StudyCase& one : scene.floor) drift = std::max(drift, one.drift.body_position.rms);
  return defect_line("noise floor (another solver seed):", scene.floor_m(ErrorMeasure::rms),
                     scene.floor_m(ErrorMeasure::p99), scene.floor_m(ErrorMeasure::max)) +
         format(", drift rms %9.4g mm (largest of %zu seeds)\n", 1e3 * drift, scene.floor.size());
}

/// The own solutions, and how far they move with more iterations and from a disturbed start.
std::string own_text(const SceneCases& scene) {
  std::string text;
  for (const StudyCase& one : scene.own) {
    const double floor_m = scene.own_floor_m(one.stepper.kind, ErrorMeasure::rms);
    text += format("    %-40s %9.4g %9.4g %9s %12s\n", setting_text(one).c_str(),
                   1e3 * one.defect.body_position.rms, 1e3 * one.own_defect.body_position.rms,
                   number_or_dash(1e3 * floor_m).c_str(), number_or_dash(one.solve_iterations).c_str());
  }
  if (text.empty()) return "";
  return format(
             "  own solutions: each stepper's equations, solved by it from the iterations below on; rms [mm] "
             "from the\n"
             "  reference, from the same with a quarter of the iterations, noise floor of the stepper; mean "
             "iterations\n"
             "    %-40s %9s %9s %9s %12s\n",
             "", "reference", "quarter", "floor", "iterations") +
         text;
}

/// How far the reference was solved, and how far it may be off.
std::string reference_text(const SceneCases& scene, const AccuracyReportOptions& options) {
  std::string text;
  if (scene.reference) {
    text += format("  reference: solved to %.3g mm a step, with %.0f iterations on average\n",
                   1e3 * scene.reference->solve_residual_m, scene.reference->solve_iterations);
  }
  text += floor_text(scene) + yardstick_text("reference with more iterations:", scene.more_iterations);
  if (scene.second_method)
    text += yardstick_text("ODE, " + stepping::setting_text(scene.second_method->stepper) + ":",
                           scene.second_method);
  return text + yardstick_text("reference with half the iterations:", scene.halved_iterations) +
         yardstick_text("reference with half the substeps:", scene.halved_substeps) +
         yardstick_text("reference with half the step:", scene.halved_dt) +
         format("  %-36s %s %.4g mm\n",
                "the reference is known to within:", measure_texts[static_cast<std::size_t>(options.measure)],
                1e3 * scene.uncertainty_m(options.measure));
}

std::string row_text(const StudyCase& one, bool at_floor) {
  const std::string remarks = remarks_text(one, at_floor);
  const analysis::ErrorSummary& error = one.defect.body_position;
  return format("  %9.3f %9.3f %10.3g  %-32s %9.4g %9.4g %9.4g %9s %9.4g %9.4g %9s  %s%s\n", 1e3 * one.time_s,
                1e3 * one.median_time_s, one.row_visits, setting_text(one).c_str(), 1e3 * error.rms,
                1e3 * error.p99, 1e3 * error.max,
                number_or_dash(1e3 * one.own_error_m(ErrorMeasure::rms)).c_str(), 1e3 * one.joint_gap_m,
                1e3 * one.drift.body_position.rms,
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
  return format("  %s: %s (%.3f ms, defect %.4g mm%s)\n  run: %s\n", asked.c_str(), setting_text(one).c_str(),
                1e3 * one.time_s, 1e3 * one.error_m(options.measure),
                inside_text(scene, one, options).c_str(), run_command(one).c_str());
}

Json case_json(const StudyCase& one, double floor_m, const AccuracyReportOptions& options) {
  Json json;
  for (const auto& [name, value] : setting_options(one)) json["options"][name] = value;
  json["frame_time_s"] = {{"worst", one.time_s}, {"median", one.median_time_s}};
  json["row_visits"] = one.row_visits;
  json["defect"] = errors_json(one.defect);
  if (one.has_own()) {
    json["own_defect"] = errors_json(one.own_defect);
    json["own_error_m"] = one.own_error_m(options.measure);
  }
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

Json own_json(const StudyCase& own, const SceneCases& scene, const AccuracyReportOptions& options) {
  return {{"stepper", std::string(stepping::name_of(own.stepper.kind))},
          {"setting", setting_text(own)},
          {"iterations", finite_or_null(own.solve_iterations)},
          {"from_reference_m", own.error_m(options.measure)},
          {"from_a_quarter_m", finite_or_null(own.own_error_m(options.measure))},
          {"noise_floor_m", finite_or_null(scene.own_floor_m(own.stepper.kind, options.measure))}};
}

std::string scene_text(const SceneCases& scene, const AccuracyReportOptions& options) {
  std::string text = "\nscene: " + scene.name + "\n" + reference_text(scene, options);
  text += own_text(scene);
  text += format(
      "  Pareto front of %zu settings; own: rms against the stepper's own solution\n  %9s %9s %10s  %-32s "
      "%9s %9s %9s %9s %9s %9s %9s  %s\n",
      scene.settings.size(), "worst ms", "median ms", "row visits", "setting (substeps x iterations)",
      "rms mm", "p99 mm", "max mm", "own mm", "gap mm", "drift mm", "creep mm/s",
      "bodies < 1 cm/1-10/10-100/> 100/inf");
  const double floor = scene.floor_m(options.measure);
  for (const std::size_t i : scene.pareto_front(options.measure)) {
    text += row_text(scene.settings[i], scene.settings[i].error_m(options.measure) <= floor);
  }
  if (!scene.estimates.empty()) {
    text +=
        "  estimates (FEEC): a frame of the setting, estimated with so many iterations a step (look: of the "
        "solve "
        "itself) after so many of its steps; times are those until the estimate is there\n";
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

bool is_inside(const SceneCases& scene, const StudyCase& one, const AccuracyReportOptions& options) {
  return one.error_m(options.measure) <= scene.uncertainty_m(options.measure);
}

std::string inside_text(const SceneCases& scene, const StudyCase& one, const AccuracyReportOptions& options) {
  if (!is_inside(scene, one, options)) return "";
  return format(": within the %.4g mm to which the reference is known",
                1e3 * scene.uncertainty_m(options.measure));
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
      "reference: sor double, cold, from %s iterations a step on, solver seed %s\n",
      measure_texts[static_cast<std::size_t>(options.measure)],
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
    for (const auto& [name, found] : {std::pair("more_iterations_m", &scene.more_iterations),
                                      std::pair("second_method_m", &scene.second_method),
                                      std::pair("halved_iterations_m", &scene.halved_iterations),
                                      std::pair("halved_substeps_m", &scene.halved_substeps),
                                      std::pair("halved_dt_m", &scene.halved_dt)}) {
      if (*found) one[name] = (*found)->error_m(options.measure);
    }
    one["uncertainty_m"] = scene.uncertainty_m(options.measure);
    if (scene.reference)
      one["reference"] = {{"residual_m", scene.reference->solve_residual_m},
                          {"iterations", scene.reference->solve_iterations}};
    for (const StudyCase& own : scene.own) one["own"].push_back(own_json(own, scene, options));
    one["front"] = Json::array();
    for (const std::size_t i : scene.pareto_front(options.measure)) {
      one["front"].push_back(case_json(scene.settings[i], floor_m, options));
    }
    for (const StudyCase& estimate : scene.estimates) {
      one["estimates"].push_back(case_json(estimate, floor_m, options));
      one["estimates"].back()["estimate"] = {{"iterations", estimate.estimate_iterations},
                                             {"after_steps", estimate.estimate_after},
                                             {"source", estimate.is_look ? "same_solve" : "short_run"}};
    }
    const auto chosen = chosen_setting(scene, options);
    if (chosen) {
      one["chosen"] = case_json(scene.settings[*chosen], floor_m, options);
      one["chosen"]["inside_uncertainty"] = is_inside(scene, scene.settings[*chosen], options);
    }
    if (chosen) one["run"] = run_command(scene.settings[*chosen]);
    json["scenes"].push_back(one);
  }
  return json_text(json, 2) + "\n";
}

std::string config_text(const StudyCase& one) {
  std::string text =
      format("# %s: frame time %.3f ms, defect rms %.4g mm, max %.4g mm\n", setting_text(one).c_str(),
             1e3 * one.time_s, 1e3 * one.defect.body_position.rms, 1e3 * one.defect.body_position.max);
  for (const auto& [name, value] : setting_options(one))
    text += format("%s = %s\n", name.c_str(), value.c_str());
  return text;
}

}  // namespace pbmpi::app
