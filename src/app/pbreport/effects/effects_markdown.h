/// A study of effects as tables in Markdown, as docs/effects.md has one.
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/effects/effects_data.h"

namespace pbmpi::app {

/// A table a stepper, effect by scene. A cell has the share of the step [%] and the defect (rms of all body
/// positions after a frame) without the effect, or in brackets the share that demanding it costs; the last
/// row is the noise floor. An effect that no scene could be measured with has no row.
std::string effects_to_markdown(const std::vector<EffectScene>& scenes);

}  // namespace pbmpi::app
