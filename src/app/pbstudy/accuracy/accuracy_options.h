/// The command line of "pbstudy accuracy".
#pragma once

#include <string>
#include <vector>

#include "app/pbstudy/study/setting_lists.h"
#include "app/pbstudy/study/study_options.h"

namespace pbmpi::app {

/// The settings that are crossed, and how each is measured.
struct AccuracyOptions : StudyOptions {
  std::vector<SettingList> settings;  ///< the stepper first; the last varies fastest
  bool with_default = true;           ///< besides them sor as it is meant to be used
  SettingList dts;                    ///< without values: the scene's and half of it
  std::vector<int> estimates;         ///< sor: iterations after which the precise solve is looked at (FEEC)
  int max_sweeps = 320;               ///< iterations x substeps of a case, at most
  int reference_iterations = 640;
  int reference_substeps = 1;
  double rest_s = 3;  ///< for which the scene at rest is watched under each setting; 0: not at all
};

/// Throws core::InputError with one clear message.
AccuracyOptions parse_accuracy_options(const std::vector<std::string>& args);

std::string accuracy_help_text();

}  // namespace pbmpi::app
