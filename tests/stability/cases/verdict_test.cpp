#include "stability/cases/verdict.h"

#include <gtest/gtest.h>

#include <cmath>

namespace pbmpi::stability {
namespace {

HardCase with_bounds(std::vector<Bound> bounds) {
  HardCase hard_case;
  hard_case.bounds = std::move(bounds);
  return hard_case;
}

CaseMeasurement measured(Metric metric, double value) {
  CaseMeasurement result;
  result.metrics[static_cast<std::size_t>(metric)] = value;
  return result;
}

TEST(Verdict, is_right_up_to_a_limit_and_broken_beyond_the_other) {
  EXPECT_EQ(verdict_of(0.1, {0.1, 0.2}), Verdict::pass);
  EXPECT_EQ(verdict_of(0.11, {0.1, 0.2}), Verdict::degraded);
  EXPECT_EQ(verdict_of(0.2, {0.1, 0.2}), Verdict::degraded);
  EXPECT_EQ(verdict_of(0.21, {0.1, 0.2}), Verdict::broken);
  EXPECT_EQ(verdict_of(NAN, {0.1, 0.2}), Verdict::broken);
}

TEST(Verdict, of_a_run_is_its_worst_and_names_the_number) {
  const HardCase hard_case = with_bounds({{Metric::drift, {1, 2}}, {Metric::joint_gap, {0.01, 0.1}}});
  CaseMeasurement run = measured(Metric::drift, 1.5);
  run.metrics[static_cast<std::size_t>(Metric::joint_gap)] = 0.3;
  const Judgement judged = judge(hard_case, run);
  EXPECT_EQ(judged.verdict, Verdict::broken);
  EXPECT_EQ(judged.decided_by, "joint_gap");
  EXPECT_EQ(judged.value, 0.3);
  EXPECT_EQ(judged.unit, "m");
  EXPECT_EQ(judged.limits.broken, 0.1);
}

TEST(Verdict, among_equals_names_the_number_nearest_to_its_limit) {
  const HardCase hard_case = with_bounds({{Metric::drift, {1, 2}}, {Metric::speed, {0.01, 0.1}}});
  CaseMeasurement run = measured(Metric::drift, 0.2);
  run.metrics[static_cast<std::size_t>(Metric::speed)] = 0.009;
  EXPECT_EQ(judge(hard_case, run).decided_by, "speed");
  EXPECT_EQ(judge(hard_case, run).verdict, Verdict::pass);
}

TEST(Verdict, of_an_expectation_names_body_and_quantity) {
  HardCase hard_case;
  hard_case.expectations = {{"ball", Quantity::vx, 1, 20, {0.02, 0.2}}};
  CaseMeasurement run;
  run.expected_off = {0.1};
  const Judgement judged = judge(hard_case, run);
  EXPECT_EQ(judged.verdict, Verdict::degraded);
  EXPECT_EQ(judged.decided_by, "ball.vx");
  EXPECT_EQ(judged.unit, "m/s");
}

TEST(Verdict, of_a_run_that_ended_before_an_expectation_is_broken) {
  HardCase hard_case;
  hard_case.expectations = {{"ball", Quantity::vx, 1, 20, {0.02, 0.2}}};
  CaseMeasurement run;
  run.expected_off = {NAN};
  EXPECT_EQ(judge(hard_case, run).verdict, Verdict::broken);
}

TEST(Verdict, of_a_lost_body_is_broken_whatever_the_bounds) {
  const Judgement judged = judge(with_bounds({{Metric::drift, {1, 2}}}), measured(Metric::nonfinite, 1));
  EXPECT_EQ(judged.verdict, Verdict::broken);
  EXPECT_EQ(judged.decided_by, "nonfinite");
}

}  // namespace
}  // namespace pbmpi::stability
