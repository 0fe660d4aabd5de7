#include "app/pbreport/accuracy/study_data.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

#include "app/common/format.h"
#include "app/pbreport/study/case_row.h"
#include "core/error.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

StudyCase read_case(const CaseRow& row) {
  StudyCase one;
  one.scene = row.text("scene");
  one.kind = row.text("kind");
  one.stepper = row.step_settings();
  one.steps_per_frame = row.integer("steps_per_frame");
  one.worlds = row.integer("worlds");
  one.warmup = row.integer("warmup");
  one.frames = row.integer("frames");
  if (row.has("estimate_iterations"))  // since version 1.1 of the file
    one.estimate_iterations = row.integer("estimate_iterations");
  if (row.has("estimate_source")) {  // since version 1.5; all estimates were looks before
    one.estimate_after = row.integer("estimate_after");
    one.is_look = row.text("estimate_source") == "same_solve";
  } else if (one.estimate_iterations > 0) {
    one.estimate_after = one.steps_per_frame - 1;
    one.is_look = true;
  }
  one.time_s = row.real("frame_time_worst");
  one.median_time_s = row.real("frame_time_median");
  one.row_visits = row.real("row_visits");
  one.joint_gap_m = row.real("joint_gap");
  one.penetration_m = row.real("penetration");
  one.energy_change_j = row.real("energy_change");
  if (row.has("rest_fallen")) {  // since version 1.2
    one.rest_fallen = row.real("rest_fallen");
    one.rest_fell_at_s = row.real("rest_fell_at");
    one.rest_creep_m_s = row.real("rest_creep");
    one.rest_energy_gain_j = row.real("rest_energy_gain");
  }
  if (row.has("solve_residual")) {  // since version 1.5
    one.solve_residual_m = row.real("solve_residual");
    one.solve_iterations = row.real("solve_iterations");
  }
  one.defect = row.errors("defect");
  one.drift = row.errors("drift");
  if (row.has("own")) {  // since version 1.6
    one.own = row.integer("own");
    one.own_defect = row.errors("own_defect");
  }
  return one;
}

double error_by(ErrorMeasure measure, const analysis::ErrorTable& errors) {
  switch (measure) {
    case ErrorMeasure::rms:
      return errors.body_position.rms;
    case ErrorMeasure::p99:
      return errors.body_position.p99;
    case ErrorMeasure::max:
      return errors.body_position.max;
    case ErrorMeasure::joint:
      return errors.joint_position.rms;
  }
  return 0;
}

void add_case(StudyCase one, SceneCases& scene) {
  const std::map<std::string, std::vector<StudyCase> SceneCases::*> lists = {
      {"setting", &SceneCases::settings},
      {"estimate", &SceneCases::estimates},
      {"floor", &SceneCases::floor},
      {"own", &SceneCases::own},
      {"own_floor", &SceneCases::own_floor}};
  const std::map<std::string, std::optional<StudyCase> SceneCases::*> yardsticks = {
      {"reference", &SceneCases::reference},
      {"more_iterations", &SceneCases::more_iterations},
      {"second_method", &SceneCases::second_method},
      {"halved_dt", &SceneCases::halved_dt},
      {"halved_iterations", &SceneCases::halved_iterations},
      {"halved_substeps", &SceneCases::halved_substeps}};
  if (const auto list = lists.find(one.kind); list != lists.end()) {
    (scene.*list->second).push_back(std::move(one));
  } else if (const auto yardstick = yardsticks.find(one.kind); yardstick != yardsticks.end()) {
    scene.*yardstick->second = std::move(one);
  }
}

}  // namespace

bool StudyCase::finite() const {
  return std::all_of(
      analysis::error_columns.begin(), analysis::error_columns.end(),
      [&](const analysis::NamedSummary& named) { return (defect.*named.summary).bands.back() == 0; });
}

double StudyCase::error_m(ErrorMeasure measure) const { return error_by(measure, defect); }

double StudyCase::own_error_m(ErrorMeasure measure) const {
  return has_own() ? error_by(measure, own_defect) : NAN;
}

std::string setting_text(const StudyCase& one) {
  std::string text = stepping::setting_text(one.stepper);
  if (one.estimate_iterations > 0) {
    text += format(one.is_look ? ", look at %d" : ", %d a step", one.estimate_iterations);
    if (one.estimate_after > 0)
      text += format(" after %d step%s", one.estimate_after, one.estimate_after == 1 ? "" : "s");
  }
  return text + format(", dt %g s", one.stepper.dt_s);
}

std::vector<std::pair<std::string, std::string>> setting_options(const StudyCase& one) {
  std::vector<std::pair<std::string, std::string>> options = {{"scene", one.scene}};
  for (const stepping::StepOption& option : stepping::step_options()) {
    if (option.in_studies && fits(option, one.stepper.kind))
      options.emplace_back(option.name, text_of(option, one.stepper));
  }
  options.insert(options.end(), {{"steps-per-frame", std::to_string(one.steps_per_frame)},
                                 {"replicas", std::to_string(one.worlds)},
                                 {"warmup", std::to_string(one.warmup)},
                                 {"frames", std::to_string(one.frames)}});
  return options;
}

double SceneCases::floor_m(ErrorMeasure measure) const {
  double most = 0;
  for (const StudyCase& one : floor) most = std::max(most, one.error_m(measure));
  return most;
}

double SceneCases::own_floor_m(stepping::StepperKind kind, ErrorMeasure measure) const {
  double most = NAN;
  for (const StudyCase& one : own_floor) {
    if (one.stepper.kind == kind) most = std::fmax(most, one.own_error_m(measure));
  }
  return most;
}

double SceneCases::uncertainty(const std::function<double(const StudyCase&)>& error) const {
  double most = 0;
  for (const StudyCase& one : floor) most = std::max(most, error(one));
  for (const auto* one : {&more_iterations, &second_method, &halved_iterations, &halved_substeps}) {
    if (*one) most = std::max(most, error(**one));
  }
  return most;
}

double SceneCases::uncertainty_m(ErrorMeasure measure) const {
  return uncertainty([measure](const StudyCase& one) { return one.error_m(measure); });
}

std::vector<std::size_t> SceneCases::pareto_front(
    const std::function<double(const StudyCase&)>& error) const {
  std::vector<std::size_t> order(settings.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    if (settings[a].time_s != settings[b].time_s) return settings[a].time_s < settings[b].time_s;
    return error(settings[a]) < error(settings[b]);
  });
  std::vector<std::size_t> front;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!settings[i].finite() || error(settings[i]) >= least) continue;
    least = error(settings[i]);
    front.push_back(i);
  }
  return front;
}

std::vector<std::size_t> SceneCases::pareto_front(ErrorMeasure measure) const {
  return pareto_front([measure](const StudyCase& one) { return one.error_m(measure); });
}

std::vector<std::size_t> SceneCases::standing_front(ErrorMeasure measure) const {
  return pareto_front([measure](const StudyCase& one) {
    return one.fells() ? std::numeric_limits<double>::infinity() : one.error_m(measure);
  });
}

std::optional<std::size_t> SceneCases::best_within(double budget_s, ErrorMeasure measure) const {
  std::optional<std::size_t> best;
  for (const std::size_t i : standing_front(measure)) {
    if (settings[i].time_s <= budget_s) best = i;
  }
  return best;
}

std::optional<std::size_t> SceneCases::cheapest_within(double tolerance_m, ErrorMeasure measure) const {
  for (const std::size_t i : standing_front(measure)) {
    if (settings[i].error_m(measure) <= tolerance_m) return i;
  }
  return std::nullopt;
}

std::vector<SceneCases> study_scenes(const io::TableFile& file, const std::vector<std::string>& names) {
  std::vector<SceneCases> scenes;
  const std::size_t num_cases = file.column<std::string>("cases", "scene").size();
  for (std::size_t i = 0; i < num_cases; ++i) {
    StudyCase one = read_case(CaseRow(file, i));
    auto scene =
        std::find_if(scenes.begin(), scenes.end(), [&](const SceneCases& s) { return s.name == one.scene; });
    if (scene == scenes.end()) {
      scenes.emplace_back().name = one.scene;
      scene = scenes.end() - 1;
    }
    add_case(std::move(one), *scene);
  }
  return chosen_scenes(scenes, names);
}

}  // namespace pbmpi::app
