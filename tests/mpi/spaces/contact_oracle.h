/// The expected contacts of a world, found by brute force, without spaces, on one rank.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "effects/fast_bodies.h"
#include "model/contact.h"
#include "model/touch_rule.h"
#include "mpi/comm/communicator.h"
#include "mpi/spaces/step/wire.h"
#include "solver/pack/pack.h"
#include "stepping/stepper.h"

namespace pbmpi::testing_support {

/// Steps the undecomposed world alongside the run on root, and tests each pair of its geoms.
class ContactOracle {
 public:
  ContactOracle(const mpi::Communicator& comm, std::shared_ptr<const model::Model> model,
                const stepping::StepperSettings& settings);

  /// Collective, once per step. `contacts`: the contacts that this rank solved. Fails the test on root unless
  /// the contacts of all ranks together are those of the undecomposed world at the start of the step, every
  /// bit, each once.
  void check(std::int64_t step, std::span<const model::Contact> contacts);

  std::int64_t contacts_checked() const { return contacts_checked_; }  ///< on root
  std::int64_t contacts_ahead_checked() const {
    return contacts_ahead_checked_;
  }  ///< those with a gap, on root

 private:
  std::vector<model::Contact> brute_force(std::int64_t step);

  const mpi::Communicator* comm_;
  std::shared_ptr<const model::Model> model_;
  double dt_s_;
  double margin_m_;  ///< distance up to which contacts are found
  model::TouchRule rule_;
  std::optional<effects::FastBodies> fast_bodies_;  ///< none without the pass
  std::unique_ptr<stepping::WorldStepper> whole_;
  std::unique_ptr<model::NarrowPhase> narrow_phase_;
  std::unique_ptr<solver::Pack> pack_;  ///< holds the world, for its colliders
  std::int64_t contacts_checked_ = 0;
  std::int64_t contacts_ahead_checked_ = 0;
};

}  // namespace pbmpi::testing_support
