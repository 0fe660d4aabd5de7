/// FEEC in the frame loop: what consumers get and when, and what FEEC must not change. Runs on 1 to 4 ranks.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "../mpi/world_driver_support.h"
#include "core/error.h"
#include "estimate/short_run.h"

namespace pbmpi::testing_support {
namespace {

using stepping::PoseKind;

/// An example consumer: draws each frame from its estimate, and learns afterwards how large the estimate's
/// error was.
class ExampleConsumer final : public stepping::PoseConsumer {
 public:
  void poses(std::int64_t frame, PoseKind kind, std::span<const model::Vec3> position,
             std::span<const model::Quat> orientation) override {
    calls.emplace_back(frame, kind);
    EXPECT_EQ(position.size(), orientation.size());
    if (kind == PoseKind::estimate) {
      drawn.assign(position.begin(), position.end());
      return;
    }
    ASSERT_EQ(position.size(), drawn.size());
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      const double error = (position[i] - drawn[i]).norm();
      num_unknown += std::isfinite(error) ? 0 : 1;
      if (std::isfinite(error)) worst_m = std::max(worst_m, error);
    }
  }

  std::vector<std::pair<std::int64_t, PoseKind>> calls;
  std::vector<model::Vec3> drawn;
  double worst_m = 0;
  int num_unknown = 0;
};

struct Outcome {
  WorldRunResult result;
  ExampleConsumer consumer;
  std::vector<double> delivered_s;
};

Outcome run_with_estimates(const WorldRunSettings& settings, SyntheticStepper::Behaviour precise,
                           SyntheticStepper::Behaviour estimate) {
  Outcome outcome;
  SyntheticStepper stepper(std::move(precise));
  estimate::ShortRun estimator(std::make_unique<SyntheticStepper>(std::move(estimate)));
  const Communicator world = Communicator::world();
  WorldDriver driver(world, stepper, synthetic_model, settings);
  driver.set_estimator(estimator);
  driver.add_consumer(outcome.consumer);
  outcome.result = driver.run();
  return outcome;
}

/// Worlds 0 to 3 of 16 cost ten times as much as the others, so that they must move.
SyntheticStepper::Behaviour dear_first_quarter() {
  SyntheticStepper::Behaviour behaviour;
  behaviour.cost_s = [](int world) { return world < 4 ? 1e-2 : 1e-3; };
  return behaviour;
}

TEST(EstimateDelivery, each_frame_is_estimated_before_it_is_precise_on_root_only) {
  const Outcome outcome = run_with_estimates(settings_of(5), {}, {});
  const bool is_root = Communicator::world().is_root();
  ASSERT_EQ(outcome.consumer.calls.size(), is_root ? 24u : 0u);
  for (std::size_t i = 0; i < outcome.consumer.calls.size(); ++i) {
    const auto kind = i % 2 == 0 ? PoseKind::estimate : PoseKind::precise;
    EXPECT_EQ(outcome.consumer.calls[i], std::pair(static_cast<std::int64_t>(i / 2), kind));
  }
}

TEST(EstimateDelivery, an_estimator_as_good_as_the_stepper_is_never_off_also_where_worlds_move) {
  const Outcome outcome = run_with_estimates(settings_of(16, 1.1), dear_first_quarter(), {});
  EXPECT_EQ(outcome.result.num_rebalances > 0, Communicator::world().size() > 1);
  EXPECT_EQ(outcome.consumer.worst_m, 0) << "every estimate starts from the precise state, bit for bit";
  EXPECT_EQ(outcome.consumer.num_unknown, 0);
}

TEST(EstimateDelivery, the_precise_hash_is_that_of_a_run_without_estimates) {
  for (const double threshold : {never, 1.1}) {
    const WorldRunSettings settings = settings_of(16, threshold);
    const Outcome outcome = run_with_estimates(settings, dear_first_quarter(), {});
    EXPECT_EQ(outcome.result.state_hash, reference_hash(settings));
  }
}

TEST(EstimateDelivery, an_estimate_that_blows_up_is_delivered_as_it_is_and_gone_in_the_next_frame) {
  SyntheticStepper::Behaviour blows_up;
  blows_up.turns_nan = [](int world, std::int64_t step) { return world == 3 && step == 7; };  // frame 2
  const WorldRunSettings settings = settings_of(5);
  const Outcome outcome = run_with_estimates(settings, {}, blows_up);
  EXPECT_EQ(outcome.consumer.num_unknown, Communicator::world().is_root() ? 1 : 0);
  EXPECT_EQ(outcome.consumer.worst_m, 0);
  EXPECT_EQ(outcome.result.failure, "");
  EXPECT_EQ(outcome.result.state_hash, reference_hash(settings));
}

TEST(EstimateDelivery, the_estimate_is_delivered_within_its_frame_and_every_rank_knows_when) {
  const Communicator comm = Communicator::world();
  const Outcome outcome = run_with_estimates(settings_of(5), {}, {});
  for (const mpi::FrameTimes& times : outcome.result.times) {
    EXPECT_GT(times.delivered_s, 0);
    EXPECT_LT(times.delivered_s, times.wall_s);
    std::array<double, 2> extremes = {times.delivered_s, -times.delivered_s};
    comm.allreduce(std::span<double>(extremes), mpi::Reduce::max);
    EXPECT_EQ(extremes[0], -extremes[1]);
  }
}

TEST(EstimateDelivery, what_an_estimator_throws_on_one_rank_is_thrown_on_every_rank) {
  SyntheticStepper::Behaviour throws;
  throws.before_step = [](int world, std::int64_t step) {
    if (world == 4 && step == 4) throw core::RunError("the estimate of world 4 failed");
  };
  EXPECT_THROW(run_with_estimates(settings_of(5), {}, throws), core::RunError);
}

}  // namespace
}  // namespace pbmpi::testing_support
