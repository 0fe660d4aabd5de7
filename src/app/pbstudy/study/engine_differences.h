/// What the engines of a study cannot express of its scenes, or take otherwise than ODE.
#pragma once

#include <set>
#include <vector>

#include "app/pbstudy/study/study_scene.h"
#include "io/table/table_file.h"
#include "stepping/stepper.h"

namespace pbmpi::app {

/// The steppers of the cases, in the order of StepperKind.
template <class Case>
std::set<stepping::StepperKind> steppers_of(const std::vector<Case>& cases) {
  std::set<stepping::StepperKind> kinds;
  for (const Case& one : cases) kinds.insert(one.stepper.kind);
  return kinds;
}

/// The columns of /differences (io/SCHEMA.md): engine, scene, text; scene by scene, in each the engines in
/// the order of `kinds`.
std::vector<io::TableColumn> engine_differences(const std::vector<SceneModel>& scenes,
                                                const std::set<stepping::StepperKind>& kinds);

}  // namespace pbmpi::app
