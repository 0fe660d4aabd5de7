/// The command line of "pbstudy accuracy".
#pragma once

#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbstudy/accuracy/nature.h"
#include "app/pbstudy/study/setting_lists.h"
#include "app/pbstudy/study/study_options.h"

namespace pbmpi::app {

/// The settings that are crossed, and how each is measured.
struct AccuracyOptions : StudyOptions {
  std::vector<SettingList> settings;  ///< the stepper first; the last varies fastest
  SettingList dts;                    ///< empty: the scene's, a half, a quarter and an eighth of it
  std::vector<int> estimates;         ///< numbers of iterations with which frames are estimated (FEEC)
  int max_sweeps = 80;                ///< iterations x substeps of a case, at most
  NatureLimits nature;
  int own_iterations = 640;         ///< per step, first tried for a stepper's own solution; 0: none
  int own_most_iterations = 10240;  ///< per step, for a frame that does not settle
  double rest_s = 3;  ///< how long the scene at rest is watched under each setting; 0: not at all
};

/// Throws core::InputError with one clear message.
AccuracyOptions parse_accuracy_options(const std::vector<std::string>& args);

Manual accuracy_manual();
Study run_accuracy;

}  // namespace pbmpi::app
