/// Work-precision diagrams of a study of accuracy.
#pragma once

#include <string>

#include "app/pbreport/accuracy/study_data.h"
#include "io/html/chart_page.h"

namespace pbmpi::app {

/// The colour of an engine in all diagrams, e.g. "#0072b2".
std::string engine_colour(stepping::StepperKind kind);

/// An error of a case [mm].
using ErrorOf = double (*)(const StudyCase&);

/// Time against error of all settings that did not blow up, of the estimates, the front, the chosen setting,
/// and what the reference leaves open. `axis`: what stands at the y axis; `measure`: which of the errors that
/// settings are ranked by it is.
io::html::Chart diagram(const SceneCases& scene, const AccuracyReportOptions& options, const char* title,
                        const char* axis, ErrorOf error_mm, ErrorMeasure measure);

}  // namespace pbmpi::app
