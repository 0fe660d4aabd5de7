/// The worlds that one rank owns: built here, handed to the stepper, passed on to other ranks.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "mpi/balance/partition.h"
#include "mpi/comm/communicator.h"
#include "stepping/frame.h"
#include "stepping/stepper.h"

namespace pbmpi::mpi {

/// Builds the model of one world; called on the rank that owns it (and again where it moves to).
using BuildWorld = std::function<std::shared_ptr<const model::Model>(int world)>;

/// Where a run begins. The same on every rank, except the states.
struct Start {
  std::int64_t step = 0;                   ///< steps done; 0 = the worlds start as their models say
  std::span<const model::State> states{};  ///< after those steps, on root: [num_worlds]
  int first_world = 0;                     ///< number of world 0 in the stepper
};

/// Knows every world's owner. The worlds of this rank live in the stepper, which numbers them from
/// Start::first_world: number_of(). Communicator and stepper are borrowed. Constructor and move() are
/// collective and throw the same error on every rank.
class OwnedWorlds {
 public:
  OwnedWorlds(const Communicator& comm, stepping::WorldStepper& stepper, BuildWorld build,
              Placement placement, const Start& start = {});

  const Placement& placement() const { return placement_; }
  const stepping::WorldTable& table() const { return table_; }
  std::span<const int> ids() const { return ids_; }  ///< this rank's, ascending
  /// The stepper's number of a world: its number in the ensemble.
  int number_of(int world) const { return first_world_ + world; }

  /// This rank's present worlds, by ascending id; valid until the stepper's next call.
  std::vector<stepping::LocalWorld> views() const;

  /// Passes worlds to their new owners between two steps: the state is sent, the model is built anew, and the
  /// result is the same bit for bit. `step`: steps done. `moves` are equal on every rank.
  void move(std::span<const Move> moves, std::int64_t step);

  /// Collective. The present states of all worlds, [num_worlds], on root; none elsewhere.
  std::vector<model::State> gather_states() const;

 private:
  void count_bodies();
  void find_own();

  const Communicator* comm_;
  stepping::WorldStepper* stepper_;
  BuildWorld build_;
  Placement placement_;
  int first_world_;
  stepping::WorldTable table_;
  std::vector<int> ids_;
};

}  // namespace pbmpi::mpi
