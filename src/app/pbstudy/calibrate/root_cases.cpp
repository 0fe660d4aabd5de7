#include <stdexcept>
#include <vector>

#include "app/pbstudy/calibrate/calibrate_cases.h"
#include "core/clock.h"
#include "mpi/balance/rebalance.h"
#include "mpi/frame/frame_driver.h"
#include "mpi/frame/pose_gather.h"
#include "synthetic/fixed_cost_stepper.h"

namespace pbmpi::app {
namespace {

template <class Work>
double seconds_of(Work&& work) {
  const double start_s = core::now_s();
  work();
  return core::now_s() - start_s;
}

stepping::WorldTable table_of(const TimedCase& one) {
  stepping::WorldTable table;
  table.body_offset.reserve(static_cast<std::size_t>(one.worlds) + 1);
  for (std::int64_t world = 0; world < one.worlds; ++world)
    table.body_offset.push_back(table.body_offset.back() + one.bodies);
  return table;
}

double time_unpack(const TimedCase& one) {
  const stepping::WorldTable table = table_of(one);
  const auto ranks = static_cast<int>(one.ranks);
  const mpi::Placement placement = mpi::equal_placement(static_cast<int>(one.worlds), ranks);
  std::vector<std::size_t> next;
  std::size_t numbers = 0;
  for (const std::int64_t bytes : mpi::share_bytes(table, placement, ranks)) {
    next.push_back(numbers);
    numbers += static_cast<std::size_t>(bytes) / sizeof(double);
  }
  const std::vector<double> received(numbers, 0.5);
  mpi::GatheredPoses poses;
  poses.resize(table);
  poses.unpack(table, placement, received,
               next);  // in a run, this memory has been touched long before
  return seconds_of([&] { poses.unpack(table, placement, received, next); });
}

/// All costs are equal.
double time_decision(const TimedCase& one) {
  const auto ranks = static_cast<int>(one.ranks);
  const mpi::Placement placement = mpi::equal_placement(static_cast<int>(one.worlds), ranks);
  const std::vector<double> cost_s(placement.size(), 1e-3);
  mpi::Rebalancer rebalancer(ranks, mpi::WorldRunSettings().rebalance_threshold);
  rebalancer.frame_done(cost_s, placement);
  return seconds_of([&] { rebalancer.frame_done(cost_s, placement); });
}

double time_bodies(const TimedCase& one) {
  const auto model = synthetic::make_model(static_cast<int>(one.bodies));
  model::State state = model::initial_state(*model);
  std::uint64_t hashes = 0;
  const double seconds = seconds_of([&] {
    for (std::int64_t world = 0; world < one.worlds; ++world) {
      state.position[0].x() = static_cast<double>(world);
      hashes ^= model::hash(state);
    }
  });
  return hashes == 0 ? 0 : seconds;  // uses the hashes, so that they are not optimised away
}

double time_hash(const TimedCase& one) {
  std::vector<std::uint64_t> hashes(static_cast<std::size_t>(one.worlds));
  for (std::size_t i = 0; i < hashes.size(); ++i) hashes[i] = i;
  std::uint64_t hash = 0;
  const double seconds = seconds_of([&] { hash = mpi::combine_world_hashes(hashes); });
  return hash == 0 ? 0 : seconds;
}

double time_table(const TimedCase& one) {
  std::int64_t bodies = 0;
  const double seconds = seconds_of([&] { bodies = table_of(one).num_bodies(); });
  return bodies < 0 ? 0 : seconds;
}

}  // namespace

double time_root(const TimedCase& one) {
  switch (one.part) {
    case TimedPart::unpack:
      return time_unpack(one);
    case TimedPart::balance:
      return time_decision(one);
    case TimedPart::table:
      return time_table(one);
    case TimedPart::hash:
      return time_hash(one);
    case TimedPart::bodies:
      return time_bodies(one);
    default:
      throw std::logic_error("time_root: a part that root alone does not do");
  }
}

}  // namespace pbmpi::app
