/// The islands that one rank can see by itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mpi/spaces/plan/island_plan.h"
#include "mpi/spaces/step/step_context.h"

namespace pbmpi::mpi {

/// Forms and weighs the islands of a rank's own units from their joints and own contacts. Sends nothing.
///
/// SpaceStep forms them before islands are shipped where something crosses spaces; otherwise only at the end
/// of a frame, for its account.
class RankIslands {
 public:
  /// `shared` is borrowed.
  explicit RankIslands(const StepContext& shared) : shared_(&shared) {}

  /// Begins a new step: the islands of the previous step are outdated.
  void start_step() { formed_ = false; }
  /// `contacts`: all own ones of the step. Does nothing if the step's islands are formed already.
  void form(std::span<const model::Contact> contacts);

  const LocalIslands& islands() const { return islands_; }
  /// [own units] rows of joints and of own contacts, and bodies
  const std::vector<std::int32_t>& unit_weight() const { return unit_weight_; }
  /// [own units] 1 for a unit with a body inside the field of interest; empty without a field
  const std::vector<char>& unit_near() const { return unit_near_; }

 private:
  void discount_outside();

  const StepContext* shared_;
  bool formed_ = false;
  LocalIslands islands_;
  std::vector<std::int32_t> unit_weight_;
  std::vector<char> unit_near_;
};

}  // namespace pbmpi::mpi
