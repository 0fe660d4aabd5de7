/// What a replay shows of a scene at rest: its bodies and geoms.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "io/table/table_file.h"
#include "model/model.h"

namespace pbmpi::app {

/// A scene whose cases have poses.
struct ReplayedScene {
  std::string name;
  std::shared_ptr<const model::Model> model;
};

/// Tables "bodies" and "geoms" (io/SCHEMA.md), scene by scene.
std::map<std::string, std::vector<io::TableColumn>> replay_tables(const std::vector<ReplayedScene>& scenes);

}  // namespace pbmpi::app
