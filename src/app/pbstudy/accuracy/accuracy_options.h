/// The command line of "pbstudy accuracy".
#pragma once

#include <string>
#include <vector>

#include "app/manual/manual.h"
#include "app/pbstudy/study/setting_lists.h"
#include "app/pbstudy/study/study_options.h"

namespace pbmpi::app {

/// The settings that are crossed, and how each is measured.
struct AccuracyOptions : StudyOptions {
  std::vector<SettingList> settings;      ///< the stepper first; the last varies fastest
  bool with_default = true;               ///< besides them sor as it is meant to be used
  SettingList dts;                        ///< without values: the scene's and half of it
  SettingList tolerances, sags;           ///< of sor as it is meant to be used
  std::vector<int> estimates;             ///< iterations with which frames are estimated (FEEC)
  int max_sweeps = 320;                   ///< iterations x substeps of a case, at most
  int reference_iterations = 640;         ///< with which each of its steps is tried first
  double reference_residual_m = 1e-5;     ///< asked of each step; 0: nothing
  int reference_most_iterations = 40960;  ///< of a step that does not get there
  int reference_check = 30;               ///< times as many iterations, for comparison; 0: no such case
  int own_iterations = 640;  ///< a step with which a stepper's own solution is tried first; 0: there is none
  int own_most_iterations = 10240;  ///< a step of a frame that does not settle
  double rest_s = 3;  ///< for which the scene at rest is watched under each setting; 0: not at all
};

/// Throws core::InputError with one clear message.
AccuracyOptions parse_accuracy_options(const std::vector<std::string>& args);

Manual accuracy_manual();

}  // namespace pbmpi::app
