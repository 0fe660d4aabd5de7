#include "mpi/frame/pose_gather.h"

#include <gtest/gtest.h>

#include "../synthetic_stepper.h"
#include "mpi/worlds/owned_worlds.h"

namespace pbmpi::mpi {
namespace {

using testing_support::synthetic_model;
using testing_support::SyntheticStepper;

constexpr int num_worlds = 11;

/// Expects on root the poses of all worlds, stepped in one place.
void expect_gathered(const PoseGather& gather, const SyntheticStepper& reference,
                     const stepping::WorldTable& table) {
  ASSERT_EQ(std::ssize(gather.position()), table.num_bodies());
  ASSERT_EQ(std::ssize(gather.orientation()), table.num_bodies());
  for (int world = 0; world < num_worlds; ++world) {
    const model::State& state = reference.state(world);
    for (int body = 0; body < state.num_bodies(); ++body) {
      EXPECT_EQ(gather.position()[table.body_offset[world] + body], state.position[body]);
      EXPECT_EQ(gather.orientation()[table.body_offset[world] + body], state.orientation[body]);
    }
    EXPECT_EQ(gather.number()[world], 0.5 + world);
  }
}

/// Gathers three frames over a tree of this radix, and moves all worlds after each.
void gather_frames(const Communicator& comm, int radix) {
  SyntheticStepper stepper;
  SyntheticStepper reference;
  Placement placement(num_worlds);
  for (int world = 0; world < num_worlds; ++world) placement[world] = (7 * world + 1) % comm.size();
  OwnedWorlds worlds(comm, stepper, synthetic_model, placement);
  const OwnedWorlds all(Communicator(), reference, synthetic_model, Placement(num_worlds, 0));
  PoseGather gather(comm, worlds.table(), worlds.placement(), radix);
  core::PhaseTimes times;
  for (int frame = 0; frame < 3; ++frame) {
    stepper.advance(2, times);
    reference.advance(2, times);
    std::vector<double> cost_s;
    for (const int world : worlds.ids()) cost_s.push_back(0.5 + world);
    gather.gather(worlds.views(), cost_s);
    if (comm.is_root()) {
      expect_gathered(gather, reference, worlds.table());
    } else {
      EXPECT_TRUE(gather.position().empty());
    }
    // Each frame gives all worlds to another rank, so that root has none in some frames.
    std::vector<Move> moves;
    for (int world = 0; world < num_worlds; ++world) {
      const int to = (frame + 1) % comm.size();
      if (worlds.placement()[world] != to) moves.push_back({world, to});
    }
    worlds.move(moves, 2 * (frame + 1));
    gather.set_placement(worlds.placement());
  }
}

TEST(PoseGather, brings_poses_and_costs_to_root_in_order_of_world_and_body_for_any_placement_and_tree) {
  const Communicator comm = Communicator::world();
  for (const int radix : {2, 3, RankTree::usual_radix}) gather_frames(comm, radix);
}

}  // namespace
}  // namespace pbmpi::mpi
