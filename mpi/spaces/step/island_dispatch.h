/// Decides which rank solves which island of a step.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/clock.h"
#include "mpi/spaces/plan/island_plan.h"
#include "mpi/spaces/step/step_context.h"
#include "mpi/spaces/step/wire.h"

namespace pbmpi::mpi {

/// Root's orders to one rank: what it ships, receives and solves in a step.
struct Orders {
  std::vector<std::int32_t> outgoing;  ///< pairs: own island (LocalIslands), rank that solves it
  std::vector<std::int32_t> arrivals;  ///< ranks that send islands
  std::vector<WireContact> contacts;   ///< contacts across spaces, in the islands that the rank solves
};

/// Root joins the ranks' islands by the contacts across spaces, chooses a solver for each joined island
/// (plan_islands()), and orders the ranks to ship. Messages: a report from each rank to root, and orders from
/// root to each rank.
///
/// SpaceStep calls dispatch() on every rank in a step in which something crosses, and not at all otherwise.
class IslandDispatch {
 public:
  /// `shared` is borrowed.
  explicit IslandDispatch(StepContext& shared) : shared_(&shared) {}

  /// `own`: this rank's islands; `crossing`: on root, contacts across spaces. Returns this rank's orders.
  Orders dispatch(const LocalIslands& own, std::span<const model::Contact> crossing, core::LapTimer& timer);

 private:
  void post_report(const LocalIslands& own);
  Orders receive_orders();
  std::vector<LocalIslands> receive_reports(const LocalIslands& own, core::LapTimer& timer);
  std::vector<Orders> plan(std::span<const LocalIslands> reports, std::span<const model::Contact> crossing);
  void post_orders(std::span<const Orders> orders);

  StepContext* shared_;
};

}  // namespace pbmpi::mpi
