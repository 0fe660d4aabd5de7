/// A study of effects as text and JSON.
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/effects/effects_data.h"

namespace pbmpi::app {

/// "57.2 %"; a dash for NaN.
std::string percent_text(double share);

/// Findings other than numbers: "no bit changes", "cannot be left out: ..."
std::string note_of(const EffectRow& row);

/// "instructions: counted by callgrind", or that they were not counted.
std::string instructions_text(const io::TableFile& file);

std::string effects_to_text(const io::TableFile& file, const std::vector<EffectScene>& scenes);
std::string effects_to_json(const io::TableFile& file, const std::vector<EffectScene>& scenes);

}  // namespace pbmpi::app
