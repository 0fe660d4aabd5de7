#include "app/pbstudy/study/engine_differences.h"

#include <gtest/gtest.h>

#include <array>
#include <string>

#include "engines/optional_engines.h"
#include "stepping/names.h"
#include "stepping/step_options.h"

namespace pbmpi::app {
namespace {

using stepping::StepperKind;
using Texts = std::vector<std::string>;

/// engine, scene, text
std::array<Texts, 3> found(const std::vector<std::string>& names, const std::set<StepperKind>& kinds) {
  std::vector<SceneModel> models;
  for (const std::string& name : names)
    models.push_back({name, scenes::parse_scene(scenes::find_scene(name))->build(0, 1)});
  const std::vector<io::TableColumn> columns = engine_differences(models, kinds);
  EXPECT_EQ(columns.size(), 3u);
  EXPECT_EQ(columns[0].name + " " + columns[1].name + " " + columns[2].name, "engine scene text");
  std::array<Texts, 3> values;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::get<Texts>(columns[i].values);
  return values;
}

TEST(EngineDifferences, odes_steppers_and_sor_have_none) {
  EXPECT_TRUE(found({"CrashSk"}, {StepperKind::quick, StepperKind::direct, StepperKind::sor})[0].empty());
}

TEST(EngineDifferences, rows_go_scene_by_scene_and_in_each_engine_by_engine) {
  Texts engine_of_row, scene_of_row;
  const std::set<StepperKind> kinds = {StepperKind::mujoco, StepperKind::sor, StepperKind::bullet};
  for (const char* const name : {"CrashSk", "2-Cars"}) {
    const auto model = scenes::parse_scene(scenes::find_scene(name))->build(0, 1);
    for (const StepperKind kind : {StepperKind::bullet, StepperKind::mujoco}) {
      const std::size_t count = engines::inexpressible(kind, *model).size();
      engine_of_row.insert(engine_of_row.end(), count, std::string(name_of(kind)));
      scene_of_row.insert(scene_of_row.end(), count, std::string(name));
    }
  }
  const auto rows = found({"CrashSk", "2-Cars"}, kinds);
  EXPECT_EQ(rows[0], engine_of_row);
  EXPECT_EQ(rows[1], scene_of_row);
}

struct AnyCase {
  stepping::StepperSettings stepper;
};

TEST(EngineDifferences, steppers_of_cases_are_in_their_own_order) {
  const stepping::StepperSettings quick = default_settings(StepperKind::quick);
  const stepping::StepperSettings mujoco = default_settings(StepperKind::mujoco);
  const std::vector<AnyCase> cases = {{mujoco}, {quick}, {mujoco}};
  const std::set<StepperKind> kinds = steppers_of(cases);
  EXPECT_EQ(std::vector(kinds.begin(), kinds.end()), (std::vector{StepperKind::quick, StepperKind::mujoco}));
}

}  // namespace
}  // namespace pbmpi::app
