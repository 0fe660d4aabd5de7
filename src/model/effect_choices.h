/// What a scene file or --effects says about effects, beyond what the model calls for.
#pragma once

#include <map>
#include <string>

namespace pbmpi::model {

struct Model;

/// Name of an effect -> true: its pass is there even if nothing calls for it; false: it is left out.
using EffectChoices = std::map<std::string, bool, std::less<>>;

/// Throws core::InputError, with the nearest names, if no effect is called that.
void require_effect(const std::string& name);

/// From "+friction,-gravity". Throws core::InputError for anything else, an unknown name, or a name twice.
EffectChoices parse_effect_choices(const std::string& text);

/// The text that parses to these choices.
std::string to_text(const EffectChoices& choices);

/// Takes out of the model what calls for the effects that model.effects leaves out, so that every stepper and
/// every measurement sees the world without them. Throws core::InputError for an effect that cannot be left
/// out, or a demanded one that needs one left out.
void leave_out_effects(Model& model);

}  // namespace pbmpi::model
