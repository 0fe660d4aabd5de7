/// Ships islands to the rank that solves them, and back.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/clock.h"
#include "mpi/spaces/step/island_dispatch.h"
#include "mpi/spaces/step/step_context.h"

namespace pbmpi::mpi {

/// Carries out a rank's Orders. Each other rank that solves an own island gets one message with the units,
/// the states of their bodies, their broken joints, the forces handed on from the previous step, and their
/// contacts. It sends one message back with the states, the broken joints and the forces after the step.
///
/// Called by SpaceStep: start_step() in each step in which something can cross, ship() once the orders are
/// known, ship_back() when all islands here are solved. ship() and ship_back() do nothing on a rank that
/// neither sends nor receives an island.
class IslandShipping {
 public:
  /// `shared` is borrowed.
  explicit IslandShipping(StepContext& shared) : shared_(&shared) {}

  void start_step();
  /// `work`: holds own units and own contacts on entry, and those of the islands that are solved here on
  /// return. `own`: this rank's islands, to which the orders refer.
  void ship(const Orders& orders, const LocalIslands& own, StepWork& work, core::LapTimer& timer);
  void ship_back(core::LapTimer& timer);

  /// Bodies that this rank has sent to be solved elsewhere since the last call.
  std::int64_t take_bodies_shipped() { return std::exchange(bodies_shipped_, 0); }

 private:
  /// Units that another rank owns and this one solves, or the other way round.
  struct Shipment {
    int rank = 0;  ///< the other rank
    std::vector<int> units;
  };
  void send(const Orders& orders, const LocalIslands& own, StepWork& work);
  void receive(const Orders& orders, StepWork& work, core::LapTimer& timer);

  StepContext* shared_;
  std::vector<Shipment> guests_;  ///< units of other ranks that are solved here in this step
  std::vector<Shipment> away_;    ///< own units that are solved elsewhere
  std::int64_t bodies_shipped_ = 0;
};

}  // namespace pbmpi::mpi
