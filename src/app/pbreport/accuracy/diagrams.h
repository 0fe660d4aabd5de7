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

/// Time against error: all settings that did not blow up, the estimates, the front, the chosen setting, and
/// the uncertainty of the reference. `axis`: label of the y axis; `measure`: which of the measures that
/// settings can be ranked by `error_mm` is.
io::html::Chart diagram(const SceneCases& scene, const AccuracyReportOptions& options, const char* title,
                        const char* axis, ErrorOf error_mm, ErrorMeasure measure);

}  // namespace pbmpi::app
