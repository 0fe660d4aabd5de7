/// What the reference of "pbstudy accuracy" is judged by.
#pragma once

#include "app/pbstudy/accuracy/case_runner.h"
#include "app/pbstudy/accuracy/reference.h"

namespace pbmpi::app {

/// Errors against the reference of a case that is_yardstick(): defect of the measured frames and, of a case
/// that is a run of its own (other seeds, half the step), drift; else no drift is counted. Nothing is
/// observed of rows, joints, contacts and rest: NaN.
CaseResult run_yardstick(const AccuracyCase& one, const StudyScene& scene, const SolvedReference& reference,
                         const AccuracyOptions& options);

}  // namespace pbmpi::app
