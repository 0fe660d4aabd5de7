/// The steps of "pbstudy prediction" that are in Python (src/app/studies): its cases, and the runs of one.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/pbstudy/study/study_scene.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// Throws core::InputError where this build has no pbvalue.
void require_tool();

/// One rank's steps, which share a folder: scenes, each under its own name, on which hashes and random
/// numbers depend, and what runs leave for later ones. It is removed with this object.
class PredictionSteps {
 public:
  /// Throws core::RunError if the folder cannot be made.
  explicit PredictionSteps(const std::vector<StudyScene>& scenes);
  ~PredictionSteps();
  PredictionSteps(const PredictionSteps&) = delete;
  PredictionSteps& operator=(const PredictionSteps&) = delete;

  /// The answer, JSON, of a step of the package to `request`. Throws core::RunError with a message that goes
  /// on after `what`.
  std::string answer(const std::string& step, nlohmann::json request, const std::string& what) const;

 private:
  std::string folder_;
};

/// Columns without rows, from their names, units, types and widths.
std::vector<io::TableColumn> empty_columns(const nlohmann::json& columns);
/// Adds a row, with a value for each column.
void add_row(const nlohmann::json& row, std::vector<io::TableColumn>& columns);

}  // namespace pbmpi::app
