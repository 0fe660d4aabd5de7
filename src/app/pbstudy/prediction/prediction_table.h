/// The results of "pbstudy prediction" as tables of its file (io/SCHEMA.md).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/pbstudy/prediction/prediction_runner.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

struct PredictionRows {
  const std::vector<StudyScene>& scenes;
  const std::vector<PredictionCase>& cases;
  const std::vector<PredictionResult>& results;  ///< [cases]
  const std::vector<PredictedFrame>& frames;     ///< case by case
  const std::vector<VariantCycles>& variants;    ///< case by case
};

std::vector<io::TableColumn> prediction_columns(const PredictionRows& rows);
std::map<std::string, std::vector<io::TableColumn>> prediction_tables(const PredictionRows& rows);

}  // namespace pbmpi::app
