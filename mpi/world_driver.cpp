#include "mpi/world_driver.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "core/error.h"
#include "core/hash.h"

namespace pbmpi::mpi {
namespace {

/// Throws core::InputError unless a driver of `num_ranks` ranks can run these settings.
void require_valid(const WorldRunSettings& settings, int num_ranks) {
  core::require_input(settings.num_worlds >= 1, "worlds: at least 1 is needed");
  core::require_input(settings.warmup >= 0, "warm-up: the number of frames is negative");
  core::require_input(settings.frames >= 1, "frames: at least 1 measured frame is needed");
  core::require_input(settings.steps_per_frame >= 1, "steps per frame: at least 1 is needed");
  core::require_input(std::isfinite(settings.dt_s) && settings.dt_s > 0,
                      "dt: a time step is finite and above 0 s");
  core::require_input(settings.rebalance_threshold >= 1, "rebalance threshold: max/avg is never below 1");
  core::require_input(settings.placement.empty() || std::ssize(settings.placement) == settings.num_worlds,
                      "placement: one rank a world is needed");
  for (const int rank : settings.placement) {
    core::require_input(rank >= 0 && rank < num_ranks, "placement: there is no rank " + std::to_string(rank));
  }
}

Placement initial_placement(const WorldRunSettings& settings, int num_ranks) {
  return settings.placement.empty() ? equal_placement(settings.num_worlds, num_ranks) : settings.placement;
}

std::uint64_t hash_of(const WorldRunSettings& settings) {
  core::Hash64 hash;
  for (const int number : {settings.num_worlds, settings.warmup, settings.frames, settings.steps_per_frame}) {
    hash.add(static_cast<std::uint64_t>(number));
  }
  for (const double number : {settings.dt_s, settings.budget_s, settings.rebalance_threshold})
    hash.add(&number, 1);
  for (const int rank : settings.placement) hash.add(static_cast<std::uint64_t>(rank));
  return hash.value();
}

/// The settings, once every rank has found them valid and the same as every other rank's.
WorldRunSettings checked(const Communicator& comm, WorldRunSettings settings) {
  agree_on_errors(comm, [&] { require_valid(settings, comm.size()); });
  const std::uint64_t mine = hash_of(settings);
  std::array<std::uint64_t, 2> extremes = {mine, ~mine};
  comm.allreduce(extremes, Reduce::max);
  core::require_invariant(extremes[0] == ~extremes[1], "WorldRunSettings are the same on every rank");
  return settings;
}

std::string describe(const Rebalancing& plan) {
  char text[96];
  std::snprintf(text, sizeof text, "%zu world%s moved: max/avg useful time %.3f -> %.3f", plan.moves.size(),
                plan.moves.size() == 1 ? "" : "s", plan.imbalance_before, plan.imbalance_after);
  return text;
}

}  // namespace

std::uint64_t combine_world_hashes(std::span<const std::uint64_t> world_hashes) {
  core::Hash64 hash;
  for (const std::uint64_t world : world_hashes) hash.add(world);
  return hash.value();
}

WorldDriver::WorldDriver(const Communicator& comm, model::WorldStepper& stepper, BuildWorld build,
                         WorldRunSettings settings)
    : comm_(comm.dup()),
      stepper_(&stepper),
      settings_(checked(comm_, std::move(settings))),
      worlds_(comm_, stepper, std::move(build), initial_placement(settings_, comm_.size())),
      gather_(comm_, worlds_.table(), worlds_.placement()),
      rebalancer_(comm_.size(), settings_.rebalance_threshold) {}

void WorldDriver::add_observer(model::FrameObserver& observer) { observers_.push_back(&observer); }
void WorldDriver::add_consumer(model::PoseConsumer& consumer) { consumers_.push_back(&consumer); }
void WorldDriver::set_estimator(model::Estimator& estimator) {
  estimator_ = &estimator;
  estimates_ = std::make_unique<PoseGather>(comm_, worlds_.table(), worlds_.placement());
}
void WorldDriver::set_stop_flag(const std::atomic<int>& flag) { stop_flag_ = &flag; }

WorldRunResult WorldDriver::run() {
  core::require_invariant(frame_ == 0, "WorldDriver::run: once a driver");
  result_.times.reserve(num_frames());
  while (frame_ < num_frames() && !result_.stopped && result_.failure.empty()) run_frame();
  agree(comm_, errors_);  // what the observers of the last frame threw
  result_.frames_done = frame_;
  result_.state_hash = state_hash();
  return std::move(result_);
}

void WorldDriver::run_frame() {
  const double start_s = core::now_s();
  model::FrameRecord record;
  record.phases[core::Phase::output] = last_output_s_;
  Estimate estimate;
  if (estimator_ != nullptr) estimate = make_estimate(start_s, record.phases);
  advance(record.phases);

  core::LapTimer timer(record.phases);
  const Status status = agree_on_status();
  timer.lap(core::Phase::wait);

  const std::vector<model::LocalWorld> worlds = worlds_.views();
  std::vector<double> cost_s;
  cost_s.reserve(worlds.size());
  for (const model::LocalWorld& world : worlds) cost_s.push_back(stepper_->cost_s(world.id));
  gather_.gather(worlds, cost_s);
  timer.lap(core::Phase::gather);

  const bool last = frame_ + 1 == num_frames() || status.stop != 0 || status.nonfinite_world >= 0;
  const Verdict verdict = decide(start_s, estimate.record.delivered_s, last);
  timer.lap(core::Phase::wait);
  if (estimator_ != nullptr) {
    if (!comm_.is_root()) errors_.guard([&] { estimates_->deliver(); });
    estimate.record.worlds = estimate.worlds;
    estimate.record.delivered_s = verdict.delivered_s;
    record.estimate = &estimate.record;
  }

  record.frame = frame_;
  record.step = (frame_ + 1) * settings_.steps_per_frame;
  record.time_s = static_cast<double>(record.step) * settings_.dt_s;
  record.measured = frame_ >= settings_.warmup;
  const std::vector<model::LocalWorld> profiled = settings_.profile ? profiled_views() : worlds;
  record.worlds = profiled;
  record.wall_s = verdict.wall_s;
  record.deadline_met = verdict.wall_s <= settings_.budget_s;
  publish(record);
  result_.times.push_back({record.wall_s, verdict.delivered_s, record.measured, record.phases});

  if (verdict.num_moves > 0) rebalance_worlds(verdict.num_moves, record.step);
  if (status.nonfinite_world >= 0) note_failure(status.nonfinite_world);
  if (status.stop != 0 && frame_ + 1 < num_frames()) {
    result_.stopped = true;
    announce({frame_, "signal", "stop requested (signal " + std::to_string(status.stop) + ")"});
  }
  ++frame_;
}

/// Messages go out whatever fails here, so that root never waits for one in vain.
WorldDriver::Estimate WorldDriver::make_estimate(double frame_start_s, core::PhaseTimes& times) {
  Estimate estimate;
  const double start_s = core::now_s();
  estimates_->expect();
  estimate.worlds = worlds_.views();
  errors_.guard([&] {
    estimator_->estimate(estimate.worlds, frame_ * settings_.steps_per_frame, settings_.steps_per_frame,
                         times);
    for (model::LocalWorld& world : estimate.worlds) {
      world.state = &estimator_->state(world.id);
      world.observables = nullptr;
    }
  });
  estimate.record.compute_s = core::now_s() - start_s;

  core::LapTimer timer(times);
  estimates_->start(estimate.worlds, std::vector<double>(estimate.worlds.size(), 0));
  timer.lap(core::Phase::gather);
  if (!comm_.is_root()) return estimate;
  estimates_->deliver();
  timer.lap(core::Phase::wait);
  estimate.record.delivered_s = core::now_s() - frame_start_s;
  hand_to_consumers(model::PoseKind::estimate, *estimates_);
  return estimate;
}

void WorldDriver::hand_to_consumers(model::PoseKind kind, const PoseGather& poses) {
  for (model::PoseConsumer* consumer : consumers_) {
    errors_.guard([&] { consumer->poses(frame_, kind, poses.position(), poses.orientation()); });
  }
}

void WorldDriver::advance(core::PhaseTimes& times) {
  if (errors_.failed() || worlds_.ids().empty()) return;
  errors_.guard([&] { stepper_->advance(settings_.steps_per_frame, times); });
}

WorldDriver::Status WorldDriver::agree_on_status() {
  // One maximum over the ranks carries all four: who is lowest counts down from the number of ranks or
  // worlds.
  enum { stop, failed, all_failed, nonfinite, count };
  const bool failed_here = errors_.failed();
  std::array<std::int64_t, count> agreed{};
  agreed[stop] = stop_flag_ ? stop_flag_->load(std::memory_order_relaxed) : 0;
  agreed[failed] = failed_here ? comm_.size() - comm_.rank() : 0;
  agreed[all_failed] = failed_here ? -1 : 0;
  if (!failed_here) agreed[nonfinite] = settings_.num_worlds - lowest_nonfinite_world();
  comm_.allreduce(agreed, Reduce::max);
  if (agreed[failed] > 0) {
    throw_error_of(comm_, errors_, comm_.size() - static_cast<int>(agreed[failed]), agreed[all_failed] == -1);
  }
  const auto world = settings_.num_worlds - static_cast<int>(agreed[nonfinite]);
  return {static_cast<int>(agreed[stop]), world < settings_.num_worlds ? world : -1};
}

int WorldDriver::lowest_nonfinite_world() const {
  for (const int world : worlds_.ids()) {
    if (stepper_->observables(world).nonfinite > 0) return world;
  }
  return settings_.num_worlds;
}

WorldDriver::Verdict WorldDriver::decide(double frame_start_s, double delivered_s, bool last) {
  Verdict verdict;
  if (comm_.is_root()) {
    verdict.delivered_s = delivered_s;
    verdict.wall_s = core::now_s() - frame_start_s;
    planned_ = {};
    if (comm_.size() > 1 && !last) {
      errors_.guard([&] { planned_ = rebalancer_.frame_done(gather_.cost_s(), worlds_.placement()); });
    }
    verdict.num_moves = std::ssize(planned_.moves);
  }
  comm_.bcast_value(verdict);
  return verdict;
}

std::vector<model::LocalWorld> WorldDriver::profiled_views() {
  errors_.guard([&] { stepper_->profile_last_step(); });
  comm_.barrier();  // else the slowest rank's measuring would be the others' wait in the next frame
  return worlds_.views();
}

void WorldDriver::publish(const model::FrameRecord& frame) {
  const double start_s = core::now_s();
  // If one observer throws the others are called all the same: they may do collective work, and a rank that
  // left it out would leave the other ranks waiting.
  for (model::FrameObserver* observer : observers_) {
    errors_.guard([&] { observer->frame_done(frame); });
  }
  if (comm_.is_root()) hand_to_consumers(model::PoseKind::precise, gather_);
  last_output_s_ = core::now_s() - start_s;
}

void WorldDriver::rebalance_worlds(std::int64_t num_moves, std::int64_t step) {
  const double start_s = core::now_s();
  planned_.moves.resize(num_moves);
  comm_.bcast(std::span(planned_.moves));
  std::string detail = comm_.is_root() ? describe(planned_) : "";
  comm_.bcast_string(detail);

  worlds_.move(planned_.moves, step);
  gather_.set_placement(worlds_.placement());
  if (estimates_) estimates_->set_placement(worlds_.placement());
  ++result_.num_rebalances;
  result_.worlds_moved += num_moves;
  result_.rebalance_s += core::now_s() - start_s;
  announce({frame_, "rebalance", detail});
}

void WorldDriver::note_failure(int world) {
  std::int64_t num_bodies = 0;
  const int owner = worlds_.placement()[world];
  if (owner == comm_.rank()) num_bodies = stepper_->observables(world).nonfinite;
  comm_.bcast_value(num_bodies, owner);
  result_.failure = "world " + std::to_string(world) + " has " + std::to_string(num_bodies) + " non-finite " +
                    (num_bodies == 1 ? "body" : "bodies") + " in frame " + std::to_string(frame_);
}

void WorldDriver::announce(const model::RunEvent& event) {
  const double start_s = core::now_s();
  for (model::FrameObserver* observer : observers_) {
    errors_.guard([&] { observer->event(event); });
  }
  last_output_s_ += core::now_s() - start_s;
}

std::uint64_t WorldDriver::state_hash() const {
  std::vector<std::uint64_t> hashes(settings_.num_worlds, 0);
  for (const int world : worlds_.ids()) hashes[world] = model::hash(stepper_->state(world));
  comm_.allreduce(hashes, Reduce::max);  // every world's hash against the zeros of those who do not own it
  return combine_world_hashes(hashes);
}

}  // namespace pbmpi::mpi
