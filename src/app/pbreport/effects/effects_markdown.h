/// A study of effects as tables in Markdown, as in docs/effects.md.
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/effects/effects_data.h"

namespace pbmpi::app {

/// One table per stepper, effect by scene. A cell has the share of the step [%] and the defect (rms of all
/// body positions after a frame) without the effect, or in brackets the share that demanding it costs; the
/// last row is the noise floor. An effect measured in no scene has no row.
std::string effects_to_markdown(const std::vector<EffectScene>& scenes);

}  // namespace pbmpi::app
