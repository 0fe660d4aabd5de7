/// A batch whose worlds are distributed over 1 to 4 ranks.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "mpi/comm/communicator.h"
#include "pbmpi/batch.h"
#include "small_worlds.h"

namespace pbmpi::test {
namespace {

BatchOptions over_ranks(int num_worlds) {
  BatchOptions options = small_options(num_worlds);
  options.communicator = mpi::Communicator::world().fortran_handle();
  return options;
}

TEST(Ranks, have_the_worlds_of_one_rank_in_blocks) {
  const mpi::Communicator world = mpi::Communicator::world();
  for (const int num_worlds : {1, 3, 7}) {  // with 4 ranks some have no world at all
    Batch all(small_options(num_worlds));
    Batch own(over_ranks(num_worlds));
    all.step(15);
    own.step(15);
    EXPECT_EQ(own.num_worlds(), num_worlds);
    for (std::size_t i = 0; i < own.world_ids().size(); ++i) {
      const int id = own.world_ids()[i];
      EXPECT_EQ(id, own.world_ids()[0] + static_cast<int>(i));
      EXPECT_EQ(own.hash(id), all.hash(id));
    }
    EXPECT_EQ(own.hash(), all.hash());
    EXPECT_EQ(own.num_bodies(), 4);
    EXPECT_EQ(own.state().position.size(), own.world_ids().size() * 4 * 3);
    own.load(own.save());
    own.step(5);
    all.step(5);
    EXPECT_EQ(own.hash(), all.hash());
  }
}

TEST(Ranks, throw_the_same_error_where_one_was_given_other_options) {
  const mpi::Communicator world = mpi::Communicator::world();
  if (world.size() == 1) GTEST_SKIP() << "one rank agrees with itself";
  BatchOptions options = over_ranks(3);
  if (world.rank() == 1) options.seed = 2;
  EXPECT_THROW(Batch batch(options), std::invalid_argument);
  options = over_ranks(3);
  if (world.rank() == 1) options.settings = {{"iterations", "none"}};
  try {
    Batch batch(options);
    ADD_FAILURE() << "not refused";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("rank 1: iterations none"), std::string::npos) << error.what();
  }
  options = over_ranks(3);
  if (world.rank() == 1) {  // the others have the text of a scene, this rank the name of one
    options.scene = "CrashSk";
    options.scene_text.clear();
  }
  EXPECT_THROW(Batch batch(options), std::invalid_argument);
}

}  // namespace
}  // namespace pbmpi::test
