#include "app/pbreport/effects/effects_data.h"

#include <algorithm>
#include <cmath>

#include "app/pbreport/study/case_row.h"
#include "app/pbreport/study/study_file.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

ReadSpread read_spread(const CaseRow& row, const std::string& name) {
  return {row.real(name), row.real(name + "_p10"), row.real(name + "_p90")};
}

std::optional<double> unless_nan(double value) {
  return std::isnan(value) ? std::nullopt : std::optional<double>(value);
}

EffectRow read_effect(const CaseRow& row, bool counted) {
  EffectRow one;
  one.scene = row.text("scene");
  one.kind = row.text("kind");
  one.effect = row.text("effect");
  one.reason = row.text("reason");
  one.stepper = row.step_settings();
  one.hash_baseline = row.text("hash_baseline");
  one.hash_variant = row.text("hash_variant");
  one.called_for = row.integer("called_for") == 1;
  if (const int same = row.integer("same_bits"); same >= 0) one.same_bits = same == 1;
  one.worlds = row.integer("worlds");
  one.time_with_s = read_spread(row, "time_with");
  one.time_without_s = read_spread(row, "time_without");
  one.cost_s = read_spread(row, "time_cost");
  one.share = read_spread(row, "time_share");
  if (counted) {
    one.instructions_with = unless_nan(row.real("instructions_with"));
    one.instructions_without = unless_nan(row.real("instructions_without"));
  }
  one.defect = row.errors("defect");
  one.drift = row.errors("drift");
  return one;
}

template <class Get>
double largest(const std::vector<EffectRow>& rows, Get&& get) {
  double most = 0;
  for (const EffectRow& row : rows) most = std::max(most, get(row));
  return most;
}

}  // namespace

std::optional<double> EffectRow::instruction_share() const {
  if (!instructions_with || !instructions_without) return std::nullopt;
  return (*instructions_with - *instructions_without) / *instructions_with;
}

double EffectScene::floor_defect_m() const {
  return largest(floor, [](const EffectRow& row) { return row.defect.body_position.rms; });
}
double EffectScene::floor_drift_m() const {
  return largest(floor, [](const EffectRow& row) { return row.drift.body_position.rms; });
}
double EffectScene::floor_share() const {
  return largest(floor, [](const EffectRow& row) { return std::abs(row.share.median); });
}

double EffectScene::step_s() const { return floor.empty() ? NAN : floor.front().time_with_s.median; }

std::vector<EffectScene> effect_scenes(const io::TableFile& file, const std::vector<std::string>& names) {
  const bool counted = instructions_by(file) != "none";
  std::vector<EffectScene> scenes;
  const std::size_t num_cases = file.column<std::string>("cases", "scene").size();
  for (std::size_t i = 0; i < num_cases; ++i) {
    EffectRow one = read_effect(CaseRow(file, i), counted);
    auto scene = std::find_if(scenes.begin(), scenes.end(), [&](const EffectScene& s) {
      return s.name == one.scene && s.stepper == stepper_text(one.stepper);
    });
    if (scene == scenes.end())
      scene = scenes.insert(scenes.end(), EffectScene{one.scene, stepper_text(one.stepper), {}, {}});
    (one.kind == "floor" ? scene->floor : scene->effects).push_back(std::move(one));
  }
  return chosen_scenes(scenes, names);
}

std::string instructions_by(const io::TableFile& file) {
  return text_parameter(file, "instructions_by", "none");
}

}  // namespace pbmpi::app
