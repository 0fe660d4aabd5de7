#include <algorithm>

#include <gtest/gtest.h>

#include "scenes/scene.h"
#include "simulation.h"

namespace pbmpi::bullet {
namespace {

class EveryScene : public testing::TestWithParam<std::string> {};

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const scenes::SceneInfo& info : scenes::list_scenes(scenes::SceneGroup::paper))
    names.push_back(info.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Bullet, EveryScene, testing::ValuesIn(scene_names()), [](const auto& one) {
  std::string name = "scene_" + one.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST_P(EveryScene, steps_and_starts_anew_from_any_state) {
  const auto scene = scenes::parse_scene(scenes::find_scene(GetParam()));
  const auto model = scene->build(0, 1);
  const auto settings = settings_of(scene->defaults().dt_s, 10);
  Simulation whole(*model, settings);
  whole.advance(20);
  Simulation rest(*model, whole.state(), 20, settings);
  whole.advance(20);
  rest.advance(20);
  EXPECT_EQ(model::hash(whole.state()), model::hash(rest.state()));
  EXPECT_EQ(whole.observables().nonfinite, 0);
  EXPECT_GT(whole.observables().contacts, 0);
}

}  // namespace
}  // namespace pbmpi::bullet
