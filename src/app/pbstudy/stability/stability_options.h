/// The command line of "pbstudy stability".
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbstudy/study/study_options.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

struct StabilitySetting {
  stepping::StepperSettings stepper;  ///< its dt_s is the scene's unless `own_dt`
  bool own_dt = false;
  bool cut = false;  ///< the world in two spaces (sor)
};

/// Reads "quick", "sor iterations=80 precision=single", "sor cut": a stepper, then step options by name,
/// including dt. Throws core::InputError for impossible ones.
StabilitySetting parse_stability_setting(const std::string& text);

/// The settings that the study takes unless told otherwise.
const std::vector<std::string>& default_stability_settings();

/// "sor single, 5 x 3, in two spaces"
std::string setting_text(const StabilitySetting& setting);

struct StabilityOptions : StudyOptions {
  std::vector<StabilitySetting> settings;
  double most_work = 0;  ///< body-steps per case; cases with more are left out
};

/// Throws core::InputError with one clear message.
StabilityOptions parse_stability_options(const std::vector<std::string>& args);

Manual stability_manual();
Study run_stability;

}  // namespace pbmpi::app
