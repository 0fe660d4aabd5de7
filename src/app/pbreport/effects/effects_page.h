/// The HTML page of a study of effects.
#pragma once

#include <string>
#include <vector>

#include "app/pbreport/effects/effects_data.h"
#include "app/pbreport/study/report_options.h"

namespace pbmpi::app {

/// Throws core::InputError if the page cannot be written.
void write_effects_page(const std::string& path, const io::TableFile& file,
                        const std::vector<EffectScene>& scenes, const ReportOfStudyOptions& options);

}  // namespace pbmpi::app
