/// The paper's statements about value prediction, each with what the study says of it.
#pragma once

#include <vector>

#include "app/pbreport/prediction/prediction_data.h"
#include "app/pbreport/study/paper_verdict.h"

namespace pbmpi::app {

/// Undecidable, all of them, of a study without scenes.
std::vector<PaperVerdict> judge_paper(const PredictionStudy& study);

}  // namespace pbmpi::app
