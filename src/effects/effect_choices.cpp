#include "effects/effect_choices.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "core/error.h"
#include "core/text.h"
#include "effects/effects.h"

namespace pbmpi::effects {
namespace {

/// Effects that act on contacts, which do not exist without collision.
constexpr std::array<EffectId, 4> needs_collision = {EffectId::friction, EffectId::restitution,
                                                     EffectId::cross_space, EffectId::fast_bodies};

void require_collision_for_its_parts(const model::Model& model) {
  if (!is_left_out(model, EffectId::collision)) return;
  for (const EffectId part : needs_collision) {
    const std::string name(effect_registry()[static_cast<std::size_t>(part)].name);
    core::require_input(
        choice_of(model, part) != std::optional<bool>(true),
        "effect '" + name +
            "' is demanded and 'collision', which it needs, is left out; drop one of the two");
  }
}

}  // namespace

void require_effect(const std::string& name) {
  std::vector<std::string> names;
  for (const Effect& effect : effect_registry()) names.emplace_back(effect.name);
  if (std::find(names.begin(), names.end(), name) != names.end()) return;
  throw core::InputError("there is no effect " + core::in_quotes(name) + core::suggestion(name, names));
}

model::EffectChoices parse_effect_choices(const std::string& text) {
  model::EffectChoices choices;
  std::istringstream stream(text);
  for (std::string item; std::getline(stream, item, ',');) {
    core::require_input(item.size() > 1 && (item[0] == '+' || item[0] == '-'),
                        "'" + item +
                            "' says neither + nor -; write +name to demand an effect, -name to leave "
                            "it out, with commas between");
    const std::string name = item.substr(1);
    require_effect(name);
    core::require_input(choices.emplace(name, item[0] == '+').second,
                        "effect '" + name + "' is named twice; drop one");
  }
  return choices;
}

std::string to_text(const model::EffectChoices& choices) {
  std::string text;
  for (const auto& [name, on] : choices) {
    text += text.empty() ? "" : ",";
    text += (on ? '+' : '-') + name;
  }
  return text;
}

void leave_out_effects(model::Model& model) {
  require_collision_for_its_parts(model);
  for (const Effect& effect : effect_registry()) {
    if (is_left_out(model, effect.id)) effect.leave_out(model);
  }
}

}  // namespace pbmpi::effects
