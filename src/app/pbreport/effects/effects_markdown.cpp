#include "app/pbreport/effects/effects_markdown.h"

#include <algorithm>
#include <cmath>

#include "app/common/format.h"

namespace pbmpi::app {
namespace {

using Scenes = std::vector<const EffectScene*>;

std::string whole_percent(double share) {
  if (!std::isfinite(share)) return "-";
  return std::to_string(std::lround(100 * share));
}

/// "44 mm", "0.2 mm"; "0" below 5 um.
std::string millimetres(double metres) {
  if (!std::isfinite(metres)) return "-";
  const double mm = 1e3 * metres;
  if (mm < 5e-3) return "0";
  return format(mm >= 1 ? "%.0f mm" : "%.1g mm", mm);
}

const EffectRow* row_of(const EffectScene& scene, const std::string& effect) {
  const auto found = std::find_if(scene.effects.begin(), scene.effects.end(),
                                  [&](const EffectRow& row) { return row.effect == effect; });
  return found == scene.effects.end() || !found->measured() ? nullptr : &*found;
}

std::string cell(const EffectScene& scene, const std::string& effect) {
  const EffectRow* row = row_of(scene, effect);
  if (row == nullptr) return "";
  const std::string share = whole_percent(row->share.median);
  if (row->demanded()) return "(" + share + (row->same_bits.value() ? ")" : "), other bits");
  return share + ", " + millimetres(row->defect.body_position.rms);
}

template <class Cell>
std::string line(const std::string& label, const Scenes& scenes, Cell cell_of) {
  std::string text = "| " + label + " |";
  for (const EffectScene* scene : scenes) {
    const std::string cell = cell_of(*scene);
    text += cell.empty() ? " |" : " " + cell + " |";
  }
  return text + "\n";
}

/// Effects that were measured in some scene, in the order of the registry.
std::vector<std::string> measured_effects(const Scenes& scenes) {
  std::vector<std::string> names;
  for (const EffectRow& row : scenes.front()->effects) {
    if (std::any_of(scenes.begin(), scenes.end(),
                    [&](const EffectScene* scene) { return row_of(*scene, row.effect) != nullptr; }))
      names.push_back(row.effect);
  }
  return names;
}

std::string table(const std::string& stepper, const Scenes& scenes) {
  std::string text = line("`" + stepper + "`", scenes, [](const EffectScene& scene) { return scene.name; });
  text += "|---";
  for (std::size_t i = 0; i < scenes.size(); ++i) text += "|---";
  text += "|\n";
  for (const std::string& effect : measured_effects(scenes))
    text += line("`" + effect + "`", scenes, [&](const EffectScene& scene) { return cell(scene, effect); });
  return text + line("noise floor", scenes, [](const EffectScene& scene) {
           return whole_percent(scene.floor_share()) + ", " + millimetres(scene.floor_defect_m());
         });
}

}  // namespace

std::string effects_to_markdown(const std::vector<EffectScene>& scenes) {
  std::string text;
  std::vector<std::string> steppers;
  for (const EffectScene& scene : scenes) {
    if (std::find(steppers.begin(), steppers.end(), scene.stepper) == steppers.end())
      steppers.push_back(scene.stepper);
  }
  for (const std::string& stepper : steppers) {
    Scenes of_stepper;
    for (const EffectScene& scene : scenes) {
      if (scene.stepper == stepper) of_stepper.push_back(&scene);
    }
    text += (text.empty() ? "" : "\n") + table(stepper, of_stepper);
  }
  return text;
}

}  // namespace pbmpi::app
