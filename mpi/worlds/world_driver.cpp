#include "mpi/worlds/world_driver.h"

#include <utility>

#include <fmt/core.h>

#include "core/marks.h"

namespace pbmpi::mpi {
namespace {

Placement initial_placement(const WorldRunSettings& settings, int num_ranks) {
  return settings.placement.empty() ? equal_placement(settings.num_worlds, num_ranks) : settings.placement;
}

std::string describe(const Rebalancing& plan) {
  return fmt::format("{} world{} moved: max/avg useful time {:.3f} -> {:.3f}", plan.moves.size(),
                     plan.moves.size() == 1 ? "" : "s", plan.imbalance_before, plan.imbalance_after);
}

}  // namespace

WorldDriver::WorldDriver(const Communicator& comm, stepping::WorldStepper& stepper, BuildWorld build,
                         const WorldRunSettings& settings, std::span<const model::State> states)
    : FrameDriver(comm, settings, settings.num_worlds),
      stepper_(&stepper),
      worlds_(this->comm(), stepper, std::move(build), initial_placement(settings, comm.size()),
              {settings.first_step(), states, settings.first_world}),
      gather_(this->comm(), worlds_.table(), worlds_.placement()),
      rebalancer_(comm.size(), settings.rebalance_threshold) {}

std::vector<WorldCost> WorldDriver::costs() const {
  std::vector<WorldCost> costs;
  for (const int world : worlds_.ids()) costs.push_back({world, stepper_->cost_s(worlds_.number_of(world))});
  return costs;
}

std::vector<int> WorldDriver::idle_ranks() const {
  std::vector<bool> owns(static_cast<std::size_t>(comm().size()), false);
  for (const int rank : placement()) owns[rank] = true;
  std::vector<int> idle;
  for (int rank = 0; rank < comm().size(); ++rank) {
    if (!owns[rank]) idle.push_back(rank);
  }
  return idle;
}

void WorldDriver::set_estimator(stepping::Estimator& estimator) {
  estimator_ = &estimator;
  gather_estimates(worlds_.table(), worlds_.placement());
}

std::span<const stepping::LocalWorld> WorldDriver::compute_estimate(std::int64_t frame,
                                                                    core::PhaseTimes& times) {
  estimated_worlds_ = worlds_.views();
  errors().guard([&] {
    const int steps = settings().steps_per_frame;
    const core::SectionMark mark(core::SectionMark::Section::estimate);
    // Steppers draw from a world's number in the ensemble.
    std::vector<stepping::LocalWorld> numbered = estimated_worlds_;
    for (stepping::LocalWorld& world : numbered) world.id = worlds_.number_of(world.id);
    estimator_->estimate(numbered, frame * steps, steps, times);
    for (stepping::LocalWorld& world : estimated_worlds_) {
      world.state = &estimator_->state(worlds_.number_of(world.id));
      world.observables = nullptr;
    }
  });
  return estimated_worlds_;
}

std::vector<stepping::LocalWorld> WorldDriver::profiled_worlds() {
  errors().guard([&] { stepper_->profile_last_step(); });
  comm().barrier();  // otherwise the other ranks would wait for the slowest measurement in the next frame
  return worlds_.views();
}

void WorldDriver::advance(core::PhaseTimes& times) {
  if (errors().failed() || worlds_.ids().empty()) return;
  errors().guard([&] { stepper_->advance(settings().steps_per_frame, times); });
}

int WorldDriver::lowest_nonfinite_world() const {
  for (const int world : worlds_.ids()) {
    if (stepper_->observables(worlds_.number_of(world)).nonfinite > 0) return world;
  }
  return settings().num_worlds;
}

std::vector<stepping::RunEvent> WorldDriver::take_events() {
  if (events_ == nullptr) return {};
  std::vector<stepping::RunEvent> events = events_->take_events();
  for (stepping::RunEvent& event : events) event.world -= settings().first_world;
  return events;
}

void WorldDriver::gather(core::PhaseTimes& times) {
  core::LapTimer timer(times);
  const std::vector<stepping::LocalWorld> worlds = worlds_.views();
  std::vector<double> cost_s;
  cost_s.reserve(worlds.size());
  for (const WorldCost& cost : costs()) cost_s.push_back(cost.seconds);
  gather_.gather(worlds, cost_s);
  timer.lap(core::Phase::gather);
}

std::int64_t WorldDriver::plan_moves(bool last) {
  planned_ = {};
  if (comm().size() > 1 && !last) {
    planned_ = rebalancer_.frame_done(gather_.number(), worlds_.placement());
  }
  return std::ssize(planned_.moves);
}

std::string WorldDriver::make_moves(std::int64_t num_moves, std::int64_t step) {
  planned_.moves.resize(num_moves);
  comm().bcast(std::span(planned_.moves));
  worlds_.move(planned_.moves, step);
  gather_.set_placement(worlds_.placement());
  place_estimates(worlds_.placement());
  return describe(planned_);
}

std::uint64_t WorldDriver::state_hash() const {
  std::vector<std::uint64_t> own;
  own.reserve(worlds_.ids().size());
  for (const int world : worlds_.ids()) own.push_back(model::hash(stepper_->state(worlds_.number_of(world))));
  return gather_state_hash(comm(), placement(), own);
}

}  // namespace pbmpi::mpi
