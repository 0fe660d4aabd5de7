#include "app/pbreport/effects/effects_text.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/common/format.h"
#include "app/common/json_text.h"
#include "app/pbreport/study/error_text.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

using Json = nlohmann::ordered_json;

std::string row_text(const EffectRow& row) {
  if (!row.measured()) return format("  %-18s %s\n", row.effect.c_str(), note_of(row).c_str());
  const auto counted = row.instruction_share();
  std::string text =
      format("  %-18s %9.2f %9.2f %9s %18s %9s", row.effect.c_str(), 1e6 * row.time_with_s.median,
             1e6 * row.cost_s.median, percent_text(row.share.median).c_str(),
             ("[" + percent_text(row.share.p10) + ", " + percent_text(row.share.p90) + "]").c_str(),
             counted ? percent_text(*counted).c_str() : "-");
  const analysis::ErrorSummary &defect = row.defect.body_position, &drift = row.drift.body_position;
  if (row.same_bits.value()) {
    text += format(" %9s %9s  %-19s", "0", "0", "");
  } else {
    text += format(" %9.4g %9.4g  %-19s", 1e3 * defect.rms, 1e3 * drift.rms, bands_text(drift.bands).c_str());
  }
  return text + "  " + note_of(row) + "\n";
}

std::string scene_text(const EffectScene& scene) {
  std::string text = "\nscene: " + scene.name + ", ";
  if (scene.effects.empty()) {
    text += scene.stepper;
  } else {
    const EffectRow& any = scene.effects.front();
    text += setting_text(any.stepper);
    text += format(", %d %s", any.worlds, any.worlds == 1 ? "world" : "worlds");
  }
  text += format("; a step takes %.1f us as the scene is\n", 1e6 * scene.step_s());
  text += format(
      "  noise floor (largest of %zu other solver seeds): time %s of a step, defect rms %.4g mm, drift rms "
      "%.4g mm\n",
      scene.floor.size(), percent_text(scene.floor_share()).c_str(), 1e3 * scene.floor_defect_m(),
      1e3 * scene.floor_drift_m());
  text += format("  %-18s %9s %9s %9s %18s %9s %9s %9s  %-19s  %s\n", "effect", "step us", "cost us",
                 "of the step", "[p10, p90]", "instr.", "defect mm", "drift mm", "bodies by drift", "");
  for (const EffectRow& row : scene.effects) text += row_text(row);
  return text;
}

Json spread_json(const ReadSpread& spread) {
  return {{"median", spread.median}, {"p10", spread.p10}, {"p90", spread.p90}};
}

Json row_json(const EffectRow& row) {
  Json json = {
      {"effect", row.effect}, {"kind", row.kind}, {"called_for", row.called_for}, {"reason", row.reason}};
  if (!row.measured()) return json;
  json["same_bits"] = row.same_bits.value();
  json["time_s"] = {{"with", spread_json(row.time_with_s)},
                    {"without", spread_json(row.time_without_s)},
                    {"cost", spread_json(row.cost_s)}};
  json["share"] = spread_json(row.share);
  if (const auto share = row.instruction_share()) {
    json["instructions"] = {
        {"with", *row.instructions_with}, {"without", *row.instructions_without}, {"share", *share}};
  }
  json["defect"] = errors_json(row.defect);
  json["drift"] = errors_json(row.drift);
  return json;
}

}  // namespace

std::string percent_text(double share) {
  if (!std::isfinite(share)) return "-";
  const std::string text = format("%.1f %%", 100 * share);
  return text == "-0.0 %" ? "0.0 %" : text;
}

std::string note_of(const EffectRow& row) {
  if (!row.measured()) return row.reason;
  const std::string what = row.demanded() ? "demanded: " : "left out: ";
  const std::string bits = row.same_bits.value() ? "; no bit changes" : "";
  if (!row.unneeded() || row.same_bits.value()) return what + row.reason + bits;
  return what + row.reason + "; AND YET THE RESULT CHANGES";
}

std::string instructions_text(const io::TableFile& file) {
  const std::string by = instructions_by(file);
  if (by == "none")
    return "instructions: not counted, the machine gave no counter (jobs/effects.sh --instructions counts "
           "them)";
  return "instructions: counted by " + by;
}

std::string effects_to_text(const io::TableFile& file, const std::vector<EffectScene>& scenes) {
  std::string text =
      "study: effects; both sides of a case start each frame from the scene's own state, in turn\n"
      "cost: with the effect - without it, median, of the processor time of a step of all worlds\n" +
      instructions_text(file) +
      "\nerror if left out: all body positions against the scene as it is; defect after one frame, drift at "
      "the end of the\nmeasured window; bodies < 1 cm/1-10/10-100/> 100/inf\n";
  for (const EffectScene& scene : scenes) text += scene_text(scene);
  return text;
}

std::string effects_to_json(const io::TableFile& file, const std::vector<EffectScene>& scenes) {
  Json json;
  json["instructions_by"] = instructions_by(file);
  json["scenes"] = Json::array();
  for (const EffectScene& scene : scenes) {
    Json one = {{"scene", scene.name}, {"stepper", scene.stepper}, {"step_s", scene.step_s()}};
    one["noise_floor"] = {{"share", scene.floor_share()},
                          {"defect_m", scene.floor_defect_m()},
                          {"drift_m", scene.floor_drift_m()}};
    one["effects"] = Json::array();
    for (const EffectRow& row : scene.effects) one["effects"].push_back(row_json(row));
    json["scenes"].push_back(std::move(one));
  }
  return json_text(json, 2) + "\n";
}

}  // namespace pbmpi::app
