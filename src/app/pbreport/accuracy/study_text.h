/// A study as text, JSON, CSV, and lines for --config.
#pragma once

#include <string>

#include "app/pbreport/accuracy/study_data.h"

namespace pbmpi::app {

/// The setting that the options ask for; none without such options, or if no setting keeps them.
std::optional<std::size_t> chosen_setting(const SceneCases& scene, const AccuracyReportOptions& options);

/// Is its error within the uncertainty of the reference?
bool is_inside(const SceneCases& scene, const StudyCase& one, const AccuracyReportOptions& options);
/// If so: ": within the 1.2 mm to which the reference is known"; otherwise empty.
std::string inside_text(const SceneCases& scene, const StudyCase& one, const AccuracyReportOptions& options);

std::string study_to_text(const io::TableFile& file, const std::vector<SceneCases>& scenes,
                          const AccuracyReportOptions& options);
std::string study_to_json(const std::vector<SceneCases>& scenes, const AccuracyReportOptions& options);
/// "fells 12 bodies at rest, the first after 1.4 s", "at the noise floor"; empty without a remark.
std::string remarks_text(const StudyCase& one, bool at_floor);
/// Lines "name = value" for pbmpi --config.
std::string config_text(const StudyCase& one);

}  // namespace pbmpi::app
