/// The command line of "pbstudy accuracy".
#pragma once

#include <string>
#include <vector>

#include "app/pbstudy/study/study_options.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// The settings that are crossed, and how each is measured.
struct AccuracyOptions : StudyOptions {
  std::vector<stepping::StepperKind> steppers;
  std::vector<int> iterations;
  std::vector<int> substeps;                    ///< sor
  std::vector<stepping::Precision> precisions;  ///< sor
  std::vector<double> sor_factors;              ///< sor
  std::vector<double> warm_starts;              ///< sor, where there are several substeps
  std::vector<stepping::RowOrder> row_orders;   ///< sor
  std::vector<int> estimates;  ///< sor: iterations after which the precise solve is looked at (FEEC)
  std::vector<double> dts_s;   ///< empty: the scene's
  int max_sweeps = 320;        ///< iterations x substeps of a case, at most
  int reference_iterations = 640;
  int reference_substeps = 1;
};

/// Throws core::InputError with one clear message.
AccuracyOptions parse_accuracy_options(const std::vector<std::string>& args);

std::string accuracy_help_text();

}  // namespace pbmpi::app
