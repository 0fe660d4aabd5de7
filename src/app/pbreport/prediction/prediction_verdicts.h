/// The paper's statements about value prediction, each with what the study says of it.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "app/pbreport/prediction/prediction_data.h"

namespace pbmpi::app {

enum class Finding { confirmed, refuted, undecidable };
inline constexpr std::array<std::string_view, 3> finding_names = {"confirmed", "refuted", "not decidable"};

struct PaperVerdict {
  std::string statement;  ///< the paper's, in short
  std::string rule;       ///< when it counts as confirmed
  Finding finding = Finding::undecidable;
  std::string number;  ///< what was found, or why nothing was
};

std::vector<PaperVerdict> judge_paper(const PredictionStudy& study);

}  // namespace pbmpi::app
