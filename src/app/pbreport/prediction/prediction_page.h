/// A study of prediction as a self-contained page.
#pragma once

#include <string>

#include "app/pbreport/prediction/prediction_data.h"

namespace pbmpi::app {

/// Throws core::InputError if it cannot be written.
void write_prediction_page(const std::string& path, const io::TableFile& file, const PredictionStudy& study,
                           const std::string& file_path);

}  // namespace pbmpi::app
