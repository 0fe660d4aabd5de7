// Resting bodies are not stepped: the effect "sleeping".
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "stepped_scene.h"

namespace pbmpi::scenes {
namespace {

constexpr int num_frames = 60, frames_until_asleep = 20;

bool is_box(const model::Body& body) { return body.name.find("_box.") != std::string::npos; }
bool stands_in_the_way(const model::Body& body) { return body.name.starts_with("aisle_box."); }

int num_asleep(const model::State& state) {
  return static_cast<int>(std::ranges::count_if(state.rest, &model::Rest::asleep));
}

// One run serves all checks, since 5,000 boxes take a second to fall asleep.
TEST(Warehouse, steps_only_what_the_forklift_touches) {
  SteppedScene scene("Warehouse");
  EXPECT_EQ(scene.reason(effects::EffectId::sleeping), "after 0.5 s below 0.05 m/s and 0.1 rad/s");
  const std::vector<model::Body>& bodies = scene.model().bodies;
  const int num_boxes = static_cast<int>(std::ranges::count_if(bodies, is_box));
  ASSERT_EQ(num_boxes, 5000);

  scene.frame();
  const int rows_awake = scene.observables().rows;
  EXPECT_GT(rows_awake, 3 * 4 * num_boxes * 0.9) << "nearly every box bears on four corners";
  for (int frame = 1; frame < frames_until_asleep; ++frame) scene.frame();
  EXPECT_EQ(num_asleep(scene.state()), num_boxes);

  std::int64_t rows = 0;
  std::set<int> woken;
  for (int frame = frames_until_asleep; frame < num_frames; ++frame) {
    scene.frame();
    rows += scene.observables().rows;
    for (int body = 0; body < scene.model().num_bodies(); ++body) {
      if (is_box(bodies[body]) && !scene.state().rest[body].asleep()) woken.insert(body);
    }
  }
  // Measured 0.2 %: the forklift's rows, and in the second half those of the eight boxes.
  EXPECT_LT(rows, 0.005 * (num_frames - frames_until_asleep) * rows_awake);
  EXPECT_EQ(woken.size(), 8u);
  for (int body = 0; body < scene.model().num_bodies(); ++body) {
    const double moved = (scene.state().position[body] - bodies[body].pose.position).norm();
    if (woken.contains(body)) {
      EXPECT_TRUE(stands_in_the_way(bodies[body])) << bodies[body].name;
      EXPECT_GT(moved, 0.1) << bodies[body].name;
    } else if (is_box(bodies[body])) {
      EXPECT_LT(moved, 1e-3) << bodies[body].name;  // has settled by its contacts' softness
    }
  }
}

}  // namespace
}  // namespace pbmpi::scenes
