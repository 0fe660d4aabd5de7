/// The HTML page of a study.
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/accuracy/study_data.h"

namespace pbmpi::app {

/// Throws core::InputError if the page cannot be written.
void write_study_page(const std::string& path, const io::TableFile& file,
                      const std::vector<SceneCases>& scenes, const AccuracyReportOptions& options);

}  // namespace pbmpi::app
