/// Reads and applies the choices of effects that a scene file or --effects makes.
#pragma once

#include <string>

#include "model/model.h"

namespace pbmpi::effects {

/// Throws core::InputError, with the nearest names, if no effect is called that.
void require_effect(const std::string& name);

/// Parses "+friction,-gravity". Throws core::InputError for anything else, an unknown name, or a name given
/// twice.
model::EffectChoices parse_effect_choices(const std::string& text);

/// The text that parses to these choices.
std::string to_text(const model::EffectChoices& choices);

/// Removes from the model what calls for the effects that model.effects leaves out, so that every stepper and
/// every measurement sees the world without them. Throws core::InputError for an effect that cannot be left
/// out, or for a demanded effect that needs one that is left out.
void leave_out_effects(model::Model& model);

}  // namespace pbmpi::effects
