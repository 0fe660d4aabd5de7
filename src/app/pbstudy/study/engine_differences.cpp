#include "app/pbstudy/study/engine_differences.h"

#include <string>

#include "app/pbstudy/study/table_columns.h"
#include "engines/optional_engines.h"
#include "stepping/names.h"

namespace pbmpi::app {

std::vector<io::TableColumn> engine_differences(const std::vector<SceneModel>& scenes,
                                                const std::set<stepping::StepperKind>& kinds) {
  struct Difference {
    std::string engine, scene, text;
  };
  std::vector<Difference> differences;
  for (const SceneModel& scene : scenes) {
    for (const stepping::StepperKind kind : kinds) {
      for (const std::string& text : engines::inexpressible(kind, *scene.model))
        differences.push_back({std::string(name_of(kind)), scene.name, text});
    }
  }
  return {column("engine", "", differences, &Difference::engine),
          column("scene", "", differences, &Difference::scene),
          column("text", "", differences, &Difference::text)};
}

}  // namespace pbmpi::app
