/// The command line of "pbstudy stability".
#pragma once

#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbstudy/stability/stability_settings.h"
#include "app/pbstudy/study/study_options.h"

namespace pbmpi::app {

struct StabilityOptions : StudyOptions {
  std::vector<StabilitySetting> settings;
  int most_poses = 1200;  ///< recorded per case for the replay
  double most_work = 0;   ///< body-steps per case; cases with more are left out
};

/// Throws core::InputError with one clear message.
StabilityOptions parse_stability_options(const std::vector<std::string>& args);

Manual stability_manual();

}  // namespace pbmpi::app
