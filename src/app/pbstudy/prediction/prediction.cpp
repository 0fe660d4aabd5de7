#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/pbstudy/prediction/prediction_options.h"
#include "app/pbstudy/prediction/prediction_steps.h"
#include "app/pbstudy/study/studies.h"
#include "app/pbstudy/study/study_runner.h"
#include "app/pbstudy/study/table_columns.h"

namespace pbmpi::app {
namespace {

using nlohmann::json;

/// 100CrSk has a hundred worlds that differ little; the default form takes ten of them.
constexpr int most_worlds = 10;

struct PredictionCase {
  int scene = 0;
  json content;  ///< as the Python program gives and takes it
};

/// The outcome of a case is the text of its rows, letter by letter.
struct PredictionResult {
  std::int32_t index = 0;
};
struct OutcomeLetter {
  std::int32_t case_index = 0;
  char letter = 0;
};
using Outcomes = CaseOutcomes<PredictionResult, OutcomeLetter>;

json options_json(const PredictionOptions& options) {
  return {{"thresholds", options.thresholds},
          {"tool_options", options.tool_options},
          {"time_limit_s", options.time_limit_s},
          {"seed", options.seed},
          {"full", options.full}};
}

json scene_json(const StudyScene& scene, const PredictionOptions& options) {
  core::require_input(scene.iterations > 1, scene.source.name + ": one iteration has none below it");
  const bool is_full = options.full || options.overrides.replicas;
  return {{"worlds", is_full ? scene.num_worlds : std::min(scene.num_worlds, most_worlds)},
          {"warmup", scene.warmup},
          {"frames", scene.frames},
          {"steps_per_frame", scene.steps_per_frame()},
          {"iterations", scene.iterations},
          {"bodies", scenes::parse_scene(scene.source)->build(0, 1)->num_bodies()},
          {"in_detail", scene.source.name == options.detail_scene}};
}

/// Collective. Root's plan for all ranks: cases, columns, a note.
json plan_of(const mpi::Communicator& comm, const json& request, const PredictionSteps& steps) {
  std::string plan = mpi::agree_on_errors(
      comm, [&] { return comm.is_root() ? steps.answer("cases", request, "the cases") : std::string(); });
  comm.bcast_string(plan);
  return json::parse(plan);
}

std::vector<PredictionCase> cases_in(const json& plan) {
  std::vector<PredictionCase> cases;
  cases.reserve(plan.at("cases").size());
  for (const json& one : plan.at("cases")) cases.push_back({one.at("scene"), one});
  return cases;
}

CaseOutcome<PredictionResult, OutcomeLetter> run_case(const PredictionCase& one, std::size_t index,
                                                      const StudyScene& scene, json request,
                                                      const PredictionSteps& steps) {
  request["index"] = index;
  request["case"] = one.content;
  request["scene"] = json(request.at("scenes").at(static_cast<std::size_t>(one.scene)));
  const std::string what = scene.source.name + ", " + one.content.at("name").get<std::string>();
  CaseOutcome<PredictionResult, OutcomeLetter> outcome;
  for (const char letter : steps.answer("run", request, what))
    outcome.rows_of<OutcomeLetter>().push_back({0, letter});
  return outcome;
}

StudyContent content_of(const json& plan, const std::vector<PredictionCase>& cases,
                        const std::vector<StudyScene>& scenes, const Outcomes& measured) {
  std::vector<std::string> texts(cases.size());
  for (const OutcomeLetter& one : measured.rows_of<OutcomeLetter>())
    texts[static_cast<std::size_t>(one.case_index)] += one.letter;
  StudyContent content;
  for (const auto& [table, columns] : plan.at("tables").items())
    content.tables[table] = empty_columns(columns);
  for (const std::string& text : texts) {
    const json outcome = json::parse(text);
    for (auto& [table, columns] : content.tables) {
      for (const json& row : outcome.at(table)) add_row(row, columns);
    }
  }
  content.cases = std::move(content.tables.extract("cases").mapped());
  content.cases.push_back(scene_column("scene", scenes, cases, &StudyScene::name));
  content.note = plan.at("note");
  return content;
}

}  // namespace

core::ExitCode run_prediction(const mpi::Communicator& comm, const std::vector<std::string>& args) {
  const PredictionOptions options = parse_prediction_options(args);
  require_tool();
  StudyRunner runner(comm, "prediction", options);
  std::optional<PredictionSteps> steps;
  mpi::agree_on_errors(comm, [&] { steps.emplace(runner.scenes()); });
  json request = {{"options", options_json(options)}};
  for (const StudyScene& scene : runner.scenes()) request["scenes"].push_back(scene_json(scene, options));
  const json plan = plan_of(comm, request, *steps);
  const std::vector<PredictionCase> cases = cases_in(plan);
  runner.open_output();
  const Outcomes measured = runner.run<PredictionResult, OutcomeLetter>(
      cases, [](const PredictionCase& one) { return one.content.at("cost").get<double>(); },
      [&](std::size_t i) { return run_case(cases[i], i, runner.scene(cases[i].scene), request, *steps); });
  runner.write([&] {
    StudyContent content = content_of(plan, cases, runner.scenes(), measured);
    content.parameters = {io::Parameter::of("budget_s", options.budget_s),
                          io::Parameter::of("figure_threshold", options.thresholds.front())};
    content.report = "jobs/paper/paper.py prediction";
    content.next = " --html prediction.html";
    return content;
  });
  return core::ExitCode::done;
}

}  // namespace pbmpi::app
