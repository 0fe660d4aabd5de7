/// The cases by which the reference of "pbstudy accuracy" is judged.
#pragma once

#include "app/pbstudy/accuracy/case_runner.h"
#include "app/pbstudy/accuracy/reference.h"

namespace pbmpi::app {

/// Errors against the reference for a case that is_yardstick(): defect of the measured frames and, for a case
/// that is a run of its own (other seeds, half the step), drift; otherwise no drift is counted. Observations
/// of rows, joints, contacts and rest are NaN.
CaseResult run_yardstick(const AccuracyCase& one, const StudyScene& scene, const SolvedReference& reference,
                         const AccuracyOptions& options);

}  // namespace pbmpi::app
