/// The paper's statements about value prediction, each judged by the study.
#pragma once

#include <vector>

#include "app/pbreport/prediction/prediction_data.h"
#include "app/pbreport/study/paper_verdict.h"

namespace pbmpi::app {

/// All statements are undecidable for a study without scenes.
std::vector<PaperVerdict> judge_paper(const PredictionStudy& study);

}  // namespace pbmpi::app
