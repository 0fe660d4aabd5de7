#include "mpi/frame/frame_driver.h"

#include <array>
#include <numeric>
#include <utility>

#include "core/error.h"
#include "core/hash.h"
#include "mpi/comm/processor_time.h"
#include "mpi/comm/tree_gather.h"
#include "mpi/frame/world_events.h"

namespace pbmpi::mpi {

namespace event_kind = stepping::event_kind;

std::uint64_t combine_world_hashes(std::span<const std::uint64_t> world_hashes) {
  core::Hash64 hash;
  for (const std::uint64_t world : world_hashes) hash.add(world);
  return hash.value();
}

std::uint64_t gather_state_hash(const Communicator& comm, std::span<const int> owner,
                                std::span<const std::uint64_t> own) {
  const std::vector<std::uint64_t> by_rank = gather_rows(comm, own);
  std::uint64_t hash = 0;
  if (comm.is_root()) {
    std::vector<std::size_t> next(static_cast<std::size_t>(comm.size()), 0);
    for (const int rank : owner) ++next[rank];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
    std::vector<std::uint64_t> hashes;
    hashes.reserve(by_rank.size());
    for (const int rank : owner) hashes.push_back(by_rank[next[rank]++]);
    hash = combine_world_hashes(hashes);
  }
  comm.bcast_value(hash);
  return hash;
}

FrameDriver::FrameDriver(const Communicator& comm, WorldRunSettings settings, int num_parts)
    : comm_(comm.dup()),
      settings_(checked_settings(comm_, std::move(settings), num_parts)),
      frame_(settings_.first_frame) {}

void FrameDriver::add_observer(stepping::FrameObserver& observer) { observers_.push_back(&observer); }
void FrameDriver::add_consumer(stepping::PoseConsumer& consumer) { consumers_.push_back(&consumer); }
void FrameDriver::set_stop_flag(const std::atomic<int>& flag) { stop_flag_ = &flag; }

void FrameDriver::save_to(SnapshotKeeper& keeper, const CheckpointPlan& plan) {
  keeper_ = &keeper;
  save_requests_ = plan.requests;
  schedule_.emplace(plan, core::now_s());
}

WorldRunResult FrameDriver::run() {
  core::require_invariant(frame_ == settings_.first_frame, "FrameDriver::run: once a driver");
  joints_break_ = any_breakage(comm_, local_worlds());
  while (frame_ < num_frames() && !result_.stopped && result_.failure.empty()) run_frame();
  agree(comm_, errors_);  // errors of observers in the last frame
  result_.frames_done = frame_;
  result_.state_hash = state_hash();
  return std::move(result_);
}

void FrameDriver::run_frame() {
  const double start_s = core::now_s(), processor_start_s = processor_time_s();
  stepping::FrameRecord record;
  record.phases[core::Phase::output] = last_output_s_;
  const double delivered_s = make_estimate(start_s, record.phases);
  advance(record.phases);

  core::LapTimer timer(record.phases);
  const Status status = agree_on_status();
  timer.lap(core::Phase::wait);
  if (status.guards_found) settle_events();
  gather(record.phases);

  core::LapTimer after(record.phases);
  const Verdict verdict = decide(start_s, delivered_s, status);
  after.lap(core::Phase::wait);
  record.estimate = finish_estimate(verdict.delivered_s);

  const std::vector<stepping::LocalWorld> worlds = settings_.profile ? profiled_worlds() : local_worlds();
  record.frame = frame_;
  record.step = (frame_ + 1) * settings_.steps_per_frame;
  record.time_s = static_cast<double>(record.step) * settings_.dt_s;
  record.measured = frame_ >= settings_.warmup;
  record.worlds = worlds;
  record.traffic = take_traffic();
  record.processor_s = processor_time_s() - processor_start_s;
  record.wall_s = verdict.wall_s;
  record.deadline_met = verdict.wall_s <= settings_.budget_s;
  publish(record);
  result_.times.push_back({record.wall_s, verdict.delivered_s, record.measured, record.phases, record.traffic,
                           record.processor_s});

  if (joints_break_) announce_breaks(worlds);
  if (status.guards_found) announce_guards();
  if (verdict.num_moves > 0) rebalance(verdict.num_moves, record.step);
  if (status.nonfinite_world >= 0 && result_.failure.empty()) note_failure(status.nonfinite_world);
  if (frame_ + 1 < num_frames()) {
    if (status.stop != 0) {
      end_early(event_kind::signal, "stop requested (signal " + std::to_string(status.stop) + ")",
                status.stop);
    } else if (verdict.time_is_up != 0) {
      end_early(event_kind::time_limit, "the time that the run was given is up");
    }
  }
  if (verdict.saves != 0) save(record.step);
  ++frame_;
}

void FrameDriver::gather_estimates(const stepping::WorldTable& table, std::span<const int> placement) {
  estimates_.emplace(comm_, table, placement);
}

/// Returns, on root, the time from the frame's start until the estimate had arrived. Messages are sent even
/// if something fails here, so that root never waits for one in vain.
double FrameDriver::make_estimate(double frame_start_s, core::PhaseTimes& times) {
  if (!estimates_) return 0;
  const double start_s = core::now_s();
  estimates_->expect();
  estimate_.worlds = compute_estimate(frame_, times);
  estimate_.compute_s = core::now_s() - start_s;

  core::LapTimer timer(times);
  estimates_->start(estimate_.worlds, std::vector<double>(estimate_.worlds.size(), 0));
  timer.lap(core::Phase::gather);
  if (!comm_.is_root()) return 0;
  estimates_->deliver();
  timer.lap(core::Phase::wait);
  const double delivered_s = core::now_s() - frame_start_s;
  hand_to_consumers(frame_, stepping::PoseKind::estimate, estimates_->position(), estimates_->orientation());
  return delivered_s;
}

/// The record of the estimate, or null; `delivered_s` is root's.
const stepping::EstimateRecord* FrameDriver::finish_estimate(double delivered_s) {
  if (!estimates_) return nullptr;
  if (!comm_.is_root()) errors_.guard([&] { estimates_->deliver(); });
  estimate_.delivered_s = delivered_s;
  return &estimate_;
}

FrameDriver::Status FrameDriver::agree_on_status() {
  // One maximum over the ranks agrees on all six numbers. The lowest rank that failed, and the lowest world,
  // are sent as their distance from the number of ranks or worlds, so the lowest wins the maximum.
  enum { stop, save_requests, failed, all_failed, nonfinite, guards, count };
  const bool failed_here = errors_.failed();
  std::array<std::int64_t, count> agreed{};
  agreed[stop] = stop_flag_ ? stop_flag_->load(std::memory_order_relaxed) : 0;
  agreed[save_requests] = save_requests_ ? save_requests_->load(std::memory_order_relaxed) : 0;
  agreed[failed] = failed_here ? comm_.size() - comm_.rank() : 0;
  agreed[all_failed] = failed_here ? -1 : 0;
  if (!failed_here) {
    agreed[nonfinite] = settings_.num_worlds - lowest_nonfinite_world();
    own_events_ = take_events();
    agreed[guards] = own_events_.empty() ? 0 : 1;
  }
  comm_.allreduce(agreed, Reduce::max);
  if (agreed[failed] > 0) {
    throw_error_of(comm_, errors_, comm_.size() - static_cast<int>(agreed[failed]), agreed[all_failed] == -1);
  }
  const auto world = settings_.num_worlds - static_cast<int>(agreed[nonfinite]);
  return {static_cast<int>(agreed[stop]), agreed[save_requests], world < settings_.num_worlds ? world : -1,
          agreed[guards] > 0};
}

FrameDriver::Verdict FrameDriver::decide(double frame_start_s, double delivered_s, const Status& status) {
  using Then = CheckpointSchedule::Then;
  Verdict verdict;
  if (comm_.is_root()) {
    const double now_s = core::now_s();
    verdict.delivered_s = delivered_s;
    verdict.wall_s = now_s - frame_start_s;
    verdict.time_is_up = now_s >= until_s_ ? 1 : 0;
    const bool failed = status.fails(settings_);
    Then then = Then::next_frame;
    if (status.stop != 0 || verdict.time_is_up != 0) then = Then::stop;
    if (frame_ + 1 == num_frames()) then = Then::end;
    if (schedule_ && !failed) verdict.saves = schedule_->due(then, status.save_requests, now_s) ? 1 : 0;
    errors_.guard([&] { verdict.num_moves = plan_moves(failed || then != Then::next_frame); });
  }
  comm_.bcast_value(verdict);
  return verdict;
}

void FrameDriver::end_early(const std::string& kind, const std::string& why, int value) {
  result_.stopped = true;
  announce({.frame = frame_, .kind = kind, .detail = why, .value = static_cast<double>(value)});
}

void FrameDriver::save(std::int64_t step) {
  const double start_s = core::now_s();
  for (stepping::FrameObserver* observer : observers_) errors_.guard([&] { observer->secure(); });
  Snapshot snapshot;
  snapshot.frames = frame_ + 1;
  snapshot.steps = step;
  const bool ends_run = result_.stopped || frame_ + 1 == num_frames();
  snapshot.ends_run = ends_run;
  snapshot.state_hash = state_hash();
  snapshot.worlds = gather_states();
  std::string failure, detail;
  if (comm_.is_root()) {
    try {
      detail = keeper_->keep(std::move(snapshot));
    } catch (const core::RunError& error) {
      failure = error.what();
      detail = "failed: " + failure;
    }
  }
  comm_.bcast_string(failure);
  comm_.bcast_string(detail);
  if (ends_run) result_.save_failure = failure;
  last_output_s_ += core::now_s() - start_s;
  announce({.frame = frame_,
            .kind = event_kind::checkpoint,
            .detail = detail,
            .value = failure.empty() ? 1.0 : 0.0});
}

void FrameDriver::publish(const stepping::FrameRecord& frame) {
  const double start_s = core::now_s();
  // If one observer throws, the others are still called: they may do collective work, and a rank that skipped
  // it would leave the other ranks waiting.
  for (stepping::FrameObserver* observer : observers_) {
    errors_.guard([&] { observer->frame_done(frame); });
  }
  if (comm_.is_root()) {
    hand_to_consumers(frame.frame, stepping::PoseKind::precise, position(), orientation());
  }
  last_output_s_ = core::now_s() - start_s;
}

void FrameDriver::hand_to_consumers(std::int64_t frame, stepping::PoseKind kind,
                                    std::span<const core::Vec3> position,
                                    std::span<const core::Quat> orientation) {
  for (stepping::PoseConsumer* consumer : consumers_) {
    errors_.guard([&] { consumer->poses(frame, kind, position, orientation); });
  }
}

void FrameDriver::rebalance(std::int64_t num_moves, std::int64_t step) {
  const double start_s = core::now_s();
  std::string detail = make_moves(num_moves, step);
  comm_.bcast_string(detail);
  ++result_.num_rebalances;
  result_.worlds_moved += num_moves;
  result_.rebalance_s += core::now_s() - start_s;
  announce({.frame = frame_,
            .kind = event_kind::rebalance,
            .detail = detail,
            .value = static_cast<double>(num_moves)});
}

void FrameDriver::note_failure(int world) {
  std::int64_t num_bodies = 0;
  const int owner = reporter_of(world);
  if (owner == comm_.rank()) num_bodies = count_nonfinite(world);
  comm_.bcast_value(num_bodies, owner);
  result_.failure = "world " + std::to_string(settings_.first_world + world) + " has " +
                    std::to_string(num_bodies) + " non-finite " + (num_bodies == 1 ? "body" : "bodies") +
                    " in frame " + std::to_string(frame_);
}

void FrameDriver::announce_breaks(std::span<const stepping::LocalWorld> worlds) {
  for (const stepping::RunEvent& event :
       find_breaks(comm_, worlds, settings_.first_world, frame_, frame_ * settings_.steps_per_frame))
    announce(event);
}

void FrameDriver::announce_guards() {
  const std::vector<stepping::RunEvent> events = share_events(comm_, own_events_, frame_);
  for (const stepping::RunEvent& event : events) announce(event);
  if (settings_.stop_at_blowup) {
    result_.failure = events.front().detail + "; the run ends here (--on-blowup stop), after frame " +
                      std::to_string(frame_);
  }
}

void FrameDriver::announce(const stepping::RunEvent& event) {
  const double start_s = core::now_s();
  for (stepping::FrameObserver* observer : observers_) {
    errors_.guard([&] { observer->event(event); });
  }
  last_output_s_ += core::now_s() - start_s;
}

}  // namespace pbmpi::mpi
