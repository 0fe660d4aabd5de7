#include "mpi/frame/checkpoint_schedule.h"

#include <gtest/gtest.h>

namespace pbmpi::mpi {
namespace {

using Then = CheckpointSchedule::Then;

TEST(CheckpointSchedule, by_itself_saves_only_what_is_stopped) {
  CheckpointSchedule schedule({}, 100);
  EXPECT_FALSE(schedule.due(Then::next_frame, 0, 1e9));
  EXPECT_FALSE(schedule.due(Then::end, 0, 1e9));
  EXPECT_TRUE(schedule.due(Then::stop, 0, 1e9));
}

TEST(CheckpointSchedule, saves_at_the_end_if_the_plan_says_so) {
  CheckpointPlan plan;
  plan.at_end = true;
  EXPECT_TRUE(CheckpointSchedule(plan, 0).due(Then::end, 0, 1));
  plan = {};
  plan.at_stop = false;
  EXPECT_FALSE(CheckpointSchedule(plan, 0).due(Then::stop, 0, 1));
}

TEST(CheckpointSchedule, answers_each_request_once) {
  CheckpointSchedule schedule({}, 0);
  EXPECT_TRUE(schedule.due(Then::next_frame, 1, 1));
  EXPECT_FALSE(schedule.due(Then::next_frame, 1, 2));
  EXPECT_TRUE(schedule.due(Then::next_frame, 3, 3)) << "two since the last frame are answered together";
  EXPECT_FALSE(schedule.due(Then::next_frame, 3, 4));
}

TEST(CheckpointSchedule, counts_the_interval_from_the_last_time_whatever_its_reason) {
  CheckpointPlan plan;
  plan.every_s = 10;
  CheckpointSchedule schedule(plan, 100);
  EXPECT_FALSE(schedule.due(Then::next_frame, 0, 109));
  EXPECT_TRUE(schedule.due(Then::next_frame, 0, 110));
  EXPECT_TRUE(schedule.due(Then::next_frame, 1, 115));
  EXPECT_FALSE(schedule.due(Then::next_frame, 1, 124));
  EXPECT_TRUE(schedule.due(Then::next_frame, 1, 125));
}

}  // namespace
}  // namespace pbmpi::mpi
