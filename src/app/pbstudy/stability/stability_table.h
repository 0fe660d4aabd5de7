/// The file of "pbstudy stability".
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/pbstudy/stability/stability_runner.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// The data for the file's columns; all [num_cases], in the order of the cases.
struct StabilityRows {
  const std::vector<StudyScene>& scenes;
  const std::vector<StabilitySetting>& settings;
  const std::vector<stability::HardCase>& hard_cases;  ///< [num_scenes]
  const std::vector<StabilityCase>& cases;
  const std::vector<StabilityResult>& results;
};

/// Columns with one row per case (io/SCHEMA.md).
std::vector<io::TableColumn> stability_columns(const StabilityRows& rows);
/// Tables "curves" and "poses".
std::map<std::string, std::vector<io::TableColumn>> stability_tables(const std::vector<CurvePoint>& points,
                                                                     const std::vector<RecordedPose>& poses);

/// What a replay shows of scenes at rest: tables "bodies" and "geoms", scene by scene.
std::map<std::string, std::vector<io::TableColumn>> replay_tables(const std::vector<SceneModel>& scenes);

/// "9 of 70 broken" for each setting, for the end of the run.
std::string stability_note(const StabilityRows& rows);

}  // namespace pbmpi::app
