#include "analysis/invariants.h"

#include <gtest/gtest.h>

#include <limits>

#include "support/models.h"

namespace pbmpi::analysis {
namespace {

using model::JointKind;
using model::State;
using model::Vec3;

/// Three rods of 0.5 m in a row along x, joined by balls; the middle one is the segment.
model::Model three_rods(model::ActorKind kind) {
  model::Model model;
  support::add_actor(model, "human", kind);
  for (int i = 0; i < 3; ++i) {
    support::add_solid(model, 0, "rod" + std::to_string(i), model::Shape::box, {0.5, 0.1, 0.1}, 2,
                       Vec3(0.5 * i, 0, 0));
  }
  for (int i = 0; i < 2; ++i)
    support::add_joint(model, JointKind::ball, i, i + 1, Vec3(0.25 + 0.5 * i, 0, 0));
  return model;
}

PoseView view(const State& state) { return {state.position, state.orientation}; }

TEST(Segments, only_parts_of_humans_with_two_joints_count) {
  EXPECT_TRUE(human_segments(three_rods(model::ActorKind::prop)).empty());
  const auto segments = human_segments(three_rods(model::ActorKind::human));
  ASSERT_EQ(segments.size(), 1u);
  EXPECT_EQ(segments[0].body, 1);
  EXPECT_NEAR(segments[0].length_m, 0.5, 1e-15);  // one rounding of 0.5
}

TEST(Segments, joints_pulled_apart_stretch_the_segment_between_them) {
  const model::Model model = three_rods(model::ActorKind::human);
  const auto segments = human_segments(model);
  State state = model::initial_state(model);
  EXPECT_NEAR(segment_stretch(model, segments, view(state))[0], 0, 1e-15);
  state.position[2].x() += 0.05;  // 0.55 m instead of 0.5 m
  EXPECT_NEAR(segment_stretch(model, segments, view(state))[0], 0.1, 1e-14);
  state.position[1] += Vec3(0.01, 0.2, 0);  // the segment's own place does not matter
  EXPECT_NEAR(segment_stretch(model, segments, view(state))[0], 0.1, 1e-14);
}

}  // namespace
}  // namespace pbmpi::analysis
