/// What a scene file or --effects says about effects, beyond what the model calls for.
#pragma once

#include <map>
#include <string>

namespace pbmpi::model {

/// Name of an effect -> true: it is demanded, with a pass even if nothing calls for it; false: it is left
/// out.
using EffectChoices = std::map<std::string, bool, std::less<>>;

}  // namespace pbmpi::model
