/// What a replay shows of a scene at rest: its bodies and geoms.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/pbstudy/study/study_scene.h"
#include "io/table/table_file.h"

namespace pbmpi::app {

/// Tables "bodies" and "geoms" (io/SCHEMA.md), scene by scene.
std::map<std::string, std::vector<io::TableColumn>> replay_tables(const std::vector<SceneModel>& scenes);

}  // namespace pbmpi::app
