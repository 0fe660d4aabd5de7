#include "app/pbreport/prediction/prediction_text.h"

#include <algorithm>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/pbreport/prediction/prediction_verdicts.h"
#include "app/pbreport/study/error_text.h"

namespace pbmpi::app {
namespace {

using Json = nlohmann::ordered_json;

std::string number_or_dash(double value, const char* pattern, double scale = 1) {
  return std::isfinite(value) ? format(pattern, scale * value) : "-";
}

std::string head_of(const PredictionScene& scene) {
  return scene.name +
         format(" (%d %s, %d + %d frames, %.2f million instructions a frame, %.0f %% of them collision)",
                scene.worlds, scene.worlds == 1 ? "world" : "worlds", scene.warmup, scene.frames,
                1e-6 * scene.base().instructions, 100 * scene.base().collision_share);
}

std::string bars_text(const PredictionScene& scene, const std::string& fvp) {
  std::string text = format("  %-12s %12s %10s\n", "Figure 8", "Hz", "satisfied");
  for (const Bar& bar : figure_8(scene, fvp)) {
    text += format("  %-12s %12s %10s", bar.name.c_str(), number_or_dash(bar.rate.hz, "%.1f").c_str(),
                   number_or_dash(bar.rate.satisfied, "%.0f %%", 100).c_str());
    if (bar.run != nullptr && !fate_text(bar.run[0]).empty()) text += "  " + fate_text(*bar.run);
    text += "\n";
  }
  return text;
}

std::string runs_text(const PredictionScene& scene) {
  std::string text = format("  %-16s %9s %9s %11s %11s  %-22s %s\n", "case", "coverage", "hit rate",
                            "drift [mm]", "defect [mm]", "drift < 1 cm ... NaN", "");
  for (const PredictionRun& run : scene.runs) {
    const HitCounts hits = run.all();
    text += format("  %-16s %9s %9s %11s %11s  %-22s %s\n", run.name.c_str(),
                   number_or_dash(hits.coverage(), "%.1f %%", 100).c_str(),
                   number_or_dash(hits.hit_rate(), "%.1f %%", 100).c_str(),
                   run.errors_known ? format("%.3g", 1e3 * run.drift_rms).c_str() : "-",
                   run.errors_known ? format("%.3g", 1e3 * run.defect_rms).c_str() : "-",
                   run.errors_known ? bands_text(run.drift_bands).c_str() : "-", fate_text(run).c_str());
  }
  const PredictionRun& base = scene.base();
  text += format("  %-16s %9s %9s %11.3g %11s  %s\n", "noise floor", "", "", 1e3 * base.floor_rms, "",
                 bands_text(base.floor_bands).c_str());
  return text;
}

const std::vector<std::string> engine_head = {"engine",          "exact: coverage", "hit rate",
                                              "fuzzy: coverage", "hit rate",        "mean accepted error"};

std::vector<std::string> engine_cells(const EngineHits& hits) {
  return {hits.engine,
          number_or_dash(hits.exact.coverage(), "%.1f %%", 100),
          number_or_dash(hits.exact.hit_rate(), "%.1f %%", 100),
          number_or_dash(hits.fuzzy.coverage(), "%.1f %%", 100),
          number_or_dash(hits.fuzzy.hit_rate(), "%.1f %%", 100),
          number_or_dash(hits.fuzzy.mean_error(), "%.1e")};
}

std::string engines_text(const PredictionStudy& study) {
  std::string text = "\nHits of floating-point results by engine (" + study.fvp + "):\n";
  const auto add_row = [&](const std::string& scene, const std::vector<std::string>& cells) {
    text += format("  %-10s %-13s %15s %9s %15s %9s %s\n", scene.c_str(), cells[0].c_str(), cells[1].c_str(),
                   cells[2].c_str(), cells[3].c_str(), cells[4].c_str(), cells[5].c_str());
  };
  add_row("scene", engine_head);
  for (const PredictionScene& scene : study.scenes) {
    for (const EngineHits& hits : engine_hits(scene, study.fvp)) add_row(scene.name, engine_cells(hits));
  }
  return text;
}

std::string markdown_row(const std::vector<std::string>& cells) {
  std::string text = "|";
  for (const std::string& cell : cells) text += " " + cell + " |";
  return text + "\n";
}

std::string engines_markdown(const PredictionStudy& study) {
  std::vector<std::string> head = engine_head;
  head.insert(head.begin(), "scene");
  std::string text = "\n" + markdown_row(head) + markdown_row(std::vector<std::string>(head.size(), "---"));
  for (const PredictionScene& scene : study.scenes) {
    for (const EngineHits& hits : engine_hits(scene, study.fvp)) {
      std::vector<std::string> cells = engine_cells(hits);
      cells.insert(cells.begin(), scene.name);
      text += markdown_row(cells);
    }
  }
  return text;
}

std::string sensitivity_text(const PredictionStudy& study) {
  if (study.sensitivity.empty()) return {};
  std::string text = "\nWhat other processors would change (cycles without and with prediction):\n";
  for (const Sensitivity& row : study.sensitivity) {
    text += format("  %-10s %-8s %-32s %14.0f %14.0f %+7.2f %%\n", row.scene.c_str(), row.run.c_str(),
                   row.variant.c_str(), row.cycles, row.predicted_cycles,
                   100 * (row.cycles / row.predicted_cycles - 1));
  }
  return text;
}

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json hits_json(const HitCounts& hits) {
  return {{"executed", hits.executed},
          {"exact", hits.exact},
          {"fuzzy", hits.fuzzy},
          {"wrong", hits.wrong},
          {"coverage", number(hits.coverage())},
          {"hit_rate", number(hits.hit_rate())},
          {"mean_accepted_error", number(hits.mean_error())},
          {"max_accepted_error", hits.error_max}};
}

Json rate_json(const FrameRate& rate) {
  return {{"hz", number(rate.hz)}, {"satisfied", number(rate.satisfied)}};
}

Json run_json(const PredictionRun& run) {
  return {{"name", run.name},
          {"stepper", run.stepper},
          {"precision", run.precision},
          {"scope", run.scope},
          {"threshold", run.threshold},
          {"ended", run.ended},
          {"frames_done", run.frames_done},
          {"measured_frames", run.measured},
          {"same_state_hash", run.same_hash},
          {"nonfinite_step", run.nonfinite_step < 0 ? Json(nullptr) : Json(run.nonfinite_step)},
          {"nonfinite_frame", run.nonfinite_frame < 0 ? Json(nullptr) : Json(run.nonfinite_frame)},
          {"islands_mean", number(run.islands)},
          {"unpredicted_islands_mean", number(run.base_islands)},
          {"instructions_per_frame", number(run.instructions)},
          {"loads", hits_json(run.loads)},
          {"operations", hits_json(run.operations)},
          {"unpredicted", rate_json(run.unpredicted)},
          {"predicted", rate_json(run.predicted)},
          {"defect_m", {{"rms", number(run.defect_rms)}, {"bands", run.defect_bands}}},
          {"drift_m", {{"rms", number(run.drift_rms)}, {"bands", run.drift_bands}}},
          {"noise_floor_m", {{"rms", number(run.floor_rms)}, {"bands", run.floor_bands}}}};
}

Json scene_json(const PredictionScene& scene, const std::string& fvp) {
  Json json = {
      {"scene", scene.name}, {"worlds", scene.worlds}, {"warmup", scene.warmup}, {"frames", scene.frames}};
  json["collision_share"] = number(scene.base().collision_share);
  for (std::size_t i = 0; i < mix_names.size(); ++i) json["mix"][mix_names[i]] = number(scene.base().mix[i]);
  for (const Bar& bar : figure_8(scene, fvp)) json["figure_8"][bar.name] = rate_json(bar.rate);
  for (const EngineHits& hits : engine_hits(scene, fvp))
    json["engines"][hits.engine] = {{"exact", hits_json(hits.exact)}, {"fuzzy", hits_json(hits.fuzzy)}};
  for (const PredictionRun& run : scene.runs) json["cases"].push_back(run_json(run));
  return json;
}

}  // namespace

std::string fate_text(const PredictionRun& run) {
  if (run.has_crashed()) return format("crashed with exit code %d", run.exit_code);
  if (!run.ended) return "not ended in time";
  if (!run.is_broken()) return {};
  return run.nonfinite_step >= 0 ? format("not finite from step %d on", run.nonfinite_step)
                                 : format("not finite from frame %d on", run.nonfinite_frame);
}

std::string prediction_to_text(const PredictionStudy& study) {
  std::string text =
      format("study: prediction; %zu scenes, cycles of the paper's Table 3 at 3 GHz, budget %.3g ms\n",
             study.scenes.size(), 1e3 * study.budget_s);
  for (const PredictionScene& scene : study.scenes)
    text += "\n" + head_of(scene) + "\n" + bars_text(scene, study.fvp) + runs_text(scene);
  text += engines_text(study) + sensitivity_text(study) + "\nThe paper's statements:\n";
  for (const PaperVerdict& verdict : judge_paper(study)) {
    text += format("  %-18s %s: ", name_of(verdict.finding).c_str(), verdict.statement.c_str()) +
            verdict.number + " (confirmed: " + verdict.rule + ")\n";
  }
  return text;
}

std::string prediction_to_json(const PredictionStudy& study) {
  Json json = {{"budget_s", study.budget_s},
               {"processor_hz", processor_hz},
               {"scenes", Json::array()},
               {"sensitivity", Json::array()},
               {"statements", Json::array()}};
  for (const PredictionScene& scene : study.scenes) json["scenes"].push_back(scene_json(scene, study.fvp));
  for (const Sensitivity& row : study.sensitivity) {
    json["sensitivity"].push_back({{"scene", row.scene},
                                   {"case", row.run},
                                   {"variant", row.variant},
                                   {"cycles", row.cycles},
                                   {"predicted_cycles", row.predicted_cycles}});
  }
  for (const PaperVerdict& verdict : judge_paper(study)) {
    json["statements"].push_back({{"statement", verdict.statement},
                                  {"finding", name_of(verdict.finding)},
                                  {"number", verdict.number},
                                  {"rule", verdict.rule}});
  }
  return json_text(json, 2) + "\n";
}

std::string prediction_to_markdown(const PredictionStudy& study) {
  std::string text = "| scene |", rule = "|---|";
  for (const Bar& bar : figure_8(study.scenes.front(), study.fvp)) {
    text += " " + bar.name + " |";
    rule += "---|";
  }
  text += "\n" + rule + "\n";
  for (const PredictionScene& scene : study.scenes) {
    text += "| " + scene.name + " |";
    for (const Bar& bar : figure_8(scene, study.fvp))
      text += " " + number_or_dash(bar.rate.hz, "%.0f") + " |";
    text += "\n";
  }
  text += engines_markdown(study) + "\n| statement | finding | number |\n|---|---|---|\n";
  for (const PaperVerdict& verdict : judge_paper(study)) {
    text += markdown_row({verdict.statement, name_of(verdict.finding), verdict.number});
  }
  return text;
}

}  // namespace pbmpi::app
