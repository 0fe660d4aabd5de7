#include "mpi/spaces/plan/root_schedule.h"

#include <gtest/gtest.h>

namespace pbmpi::mpi {
namespace {

// Times are seconds that doubles represent exactly, so nothing here is rounded.

/// Root sent its verdict at 0 and has solved at 100.
RootSchedule after_a_step(const StepPace& own, const StepPace& other, double search_s, int num_ranks = 2) {
  RootSchedule schedule(num_ranks);
  schedule.start_all(-other.collide_s);
  schedule.note_verdict(0, search_s);
  for (int rank = 1; rank < num_ranks; ++rank) schedule.note_arrival(rank, -1000, -other.collide_s, other);
  schedule.start_all(-other.collide_s);
  schedule.note_own(own);
  return schedule;
}

TEST(RootSchedule, expects_poses_a_solve_after_the_verdict_or_after_a_late_collision) {
  RootSchedule schedule(2);
  schedule.note_arrival(1, 0, 0, {20, 100});
  schedule.start_all(0);
  schedule.note_verdict(10, 5);
  EXPECT_EQ(schedule.expected_s(), 120) << "the rank collides until 20";
  schedule.note_verdict(30, 5);
  EXPECT_EQ(schedule.expected_s(), 130);
}

TEST(RootSchedule, takes_the_time_it_expected_for_that_of_an_arrival_it_did_not_see) {
  RootSchedule schedule(2);
  schedule.note_arrival(1, 0, 0, {20, 100});
  schedule.start_all(0);
  schedule.note_verdict(30, 5);
  schedule.note_arrival(1, 125, 150, {20, 100});  // expected at 130
  schedule.note_verdict(131, 5);
  EXPECT_EQ(schedule.expected_s(), 130 + 20 + 100);
  schedule.note_arrival(1, 190, 200, {20, 100});  // they had arrived by then
  schedule.note_verdict(201, 5);
  EXPECT_EQ(schedule.expected_s(), 200 + 20 + 100);
}

TEST(RootSchedule, expects_the_last_of_all_ranks) {
  RootSchedule schedule(3);
  schedule.note_arrival(1, 0, 0, {20, 100});
  schedule.note_arrival(2, 0, 0, {20, 300});
  schedule.start_all(0);
  schedule.note_verdict(30, 5);
  EXPECT_EQ(schedule.expected_s(), 330);
}

TEST(RootSchedule, waits_for_poses_that_are_due) {
  const RootSchedule schedule = after_a_step({25, 80}, {25, 104}, 20);
  EXPECT_TRUE(schedule.should_wait(100)) << "4 to go; colliding first would hold the other up by 21";
  EXPECT_FALSE(schedule.should_wait(70)) << "34 to go: root's collision takes 25";
}

TEST(RootSchedule, gives_up_waiting_for_poses_that_do_not_come) {
  const RootSchedule schedule = after_a_step({25, 80}, {25, 104}, 20);
  EXPECT_TRUE(schedule.should_wait(104 + 20));
  EXPECT_FALSE(schedule.should_wait(104 + 26)) << "by now root could have collided";
}

TEST(RootSchedule, collides_first_if_root_is_the_last_to_finish) {
  const RootSchedule schedule = after_a_step({25, 200}, {25, 104}, 20);
  EXPECT_FALSE(schedule.should_wait(100)) << "each second of waiting ends the step a second later";
}

TEST(RootSchedule, does_not_wait_before_it_knows_its_own_pace) {
  const RootSchedule schedule = after_a_step({}, {25, 104}, 20);
  EXPECT_FALSE(schedule.should_wait(100));
}

}  // namespace
}  // namespace pbmpi::mpi
