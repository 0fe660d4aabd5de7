#include "mpi/worlds/owned_worlds.h"

#include <gtest/gtest.h>

#include "../synthetic_stepper.h"
#include "core/error.h"
#include "model/state_parts.h"

namespace pbmpi::mpi {
namespace {

using testing_support::synthetic_model;
using testing_support::SyntheticStepper;

Placement round_robin(int num_worlds, int num_ranks, int shift = 0) {
  Placement placement(num_worlds);
  for (int world = 0; world < num_worlds; ++world) placement[world] = (world + shift) % num_ranks;
  return placement;
}

std::vector<Move> moves_to(const Placement& from, const Placement& to) {
  std::vector<Move> moves;
  for (int world = 0; world < std::ssize(from); ++world) {
    if (from[world] != to[world]) moves.push_back({world, to[world]});
  }
  return moves;
}

TEST(OwnedWorlds, builds_only_its_own_and_knows_the_bodies_of_all) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper;
  std::vector<int> built;
  const OwnedWorlds worlds(
      comm, stepper,
      [&](int world) {
        built.push_back(world);
        return synthetic_model(world);
      },
      round_robin(7, comm.size()));
  EXPECT_EQ(built, std::vector<int>(worlds.ids().begin(), worlds.ids().end()));
  EXPECT_EQ(stepper.num_worlds(), std::ssize(built));
  EXPECT_EQ(worlds.table().body_offset, (std::vector<std::int64_t>{0, 1, 3, 6, 7, 9, 12, 13}));
  const std::vector<stepping::LocalWorld> views = worlds.views();
  ASSERT_EQ(views.size(), built.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].id, built[i]);
    EXPECT_EQ(views[i].id % comm.size(), comm.rank());
    EXPECT_EQ(views[i].model->num_bodies(), 1 + views[i].id % 3);
  }
}

void expect_same_rest(const model::State& a, const model::State& b) {
  std::vector<double> rows_a, rows_b;
  model::append_rows(a.rest, rows_a);
  model::append_rows(b.rest, rows_b);
  EXPECT_EQ(rows_a, rows_b);
}

class Ring : public testing::TestWithParam<std::tuple<bool, int>> {};
INSTANTIATE_TEST_SUITE_P(WithAndWithoutRestAndJoints, Ring,
                         testing::Combine(testing::Bool(), testing::Values(0, 7)));

TEST_P(Ring, of_worlds_is_passed_on_bit_for_bit) {
  const Communicator comm = Communicator::world();
  constexpr int num_worlds = 9;
  SyntheticStepper::Behaviour behaviour;
  std::tie(behaviour.rests, behaviour.num_joints) = GetParam();
  behaviour.remembers = behaviour.rests;
  SyntheticStepper moving(behaviour);
  SyntheticStepper staying(behaviour);
  OwnedWorlds worlds(comm, moving, synthetic_model, round_robin(num_worlds, comm.size()));
  const OwnedWorlds all(Communicator(), staying, synthetic_model, Placement(num_worlds, 0));
  core::PhaseTimes times;
  for (int round = 1; round <= 5; ++round) {
    moving.advance(3, times);
    staying.advance(3, times);
    const std::vector<model::State> gathered = worlds.gather_states();
    ASSERT_EQ(std::ssize(gathered), comm.is_root() ? num_worlds : 0);
    for (std::size_t world = 0; world < gathered.size(); ++world)
      EXPECT_EQ(model::hash(gathered[world]), model::hash(staying.state(static_cast<int>(world))));
    const Placement next = round_robin(num_worlds, comm.size(), round);
    worlds.move(moves_to(worlds.placement(), next), 3 * round);
    EXPECT_EQ(worlds.placement(), next);
    EXPECT_EQ(moving.num_worlds(), std::ssize(worlds.ids()));
    for (const int world : worlds.ids()) {
      EXPECT_EQ(next[world], comm.rank());
      EXPECT_EQ(model::hash(moving.state(world)), model::hash(staying.state(world))) << "world " << world;
      expect_same_rest(moving.state(world), staying.state(world));
      EXPECT_EQ(moving.state(world).broken_in, staying.state(world).broken_in);
    }
  }
}

TEST(OwnedWorlds, throws_on_every_rank_what_building_throws_on_one) {
  const Communicator comm = Communicator::world();
  SyntheticStepper stepper;
  const auto build = [](int world) {
    if (world == 4) throw core::InputError("world 4: mass is NaN");
    return synthetic_model(world);
  };
  try {
    const OwnedWorlds worlds(comm, stepper, build, round_robin(7, comm.size()));
    FAIL() << "no error";
  } catch (const core::InputError& error) {
    const std::string prefix = comm.size() > 1 ? "rank " + std::to_string(4 % comm.size()) + ": " : "";
    EXPECT_EQ(error.what(), prefix + "world 4: mass is NaN");
  }
}

TEST(OwnedWorlds, refuses_another_model_where_a_world_arrives) {
  const Communicator comm = Communicator::world();
  if (comm.size() == 1) GTEST_SKIP() << "needs two ranks";
  SyntheticStepper stepper;
  // World 0 begins on rank 0, where it has one body, but it has two on any other rank.
  const auto build = [&](int world) { return synthetic_model(comm.is_root() ? world : world + 1); };
  OwnedWorlds worlds(comm, stepper, build, Placement{0});
  const std::vector<Move> moves = {{0, 1}};
  EXPECT_THROW(worlds.move(moves, 0), core::RunError);
}

}  // namespace
}  // namespace pbmpi::mpi
