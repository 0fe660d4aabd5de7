/// The command line of "pbstudy effects".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbstudy/study/setting_lists.h"
#include "app/pbstudy/study/study_options.h"

namespace pbmpi::app {

struct EffectsOptions : StudyOptions {
  std::vector<std::string> effects;   ///< names in the registry's order
  std::vector<SettingList> settings;  ///< of the steppers to measure
  std::optional<int> iterations;      ///< empty: the scene's
};

/// Throws core::InputError with one clear message.
EffectsOptions parse_effects_options(const std::vector<std::string>& args);

Manual effects_manual();

}  // namespace pbmpi::app
