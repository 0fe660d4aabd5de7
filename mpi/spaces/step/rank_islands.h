/// The islands that one rank can see by itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mpi/spaces/plan/island_plan.h"
#include "mpi/spaces/step/step_context.h"

namespace pbmpi::mpi {

/// Forms the islands of a rank's own units from joints and own contacts, and weighs them. Sends nothing.
///
/// SpaceStep has them formed where something crosses spaces, before islands are shipped; otherwise at the
/// end of a frame only, for the account of the frame.
class RankIslands {
 public:
  /// `shared` is borrowed.
  explicit RankIslands(const StepContext& shared) : shared_(&shared) {}

  /// A new step: the islands of the last one are outdated.
  void start_step() { formed_ = false; }
  /// `contacts`: all own ones of the step. Does nothing where the step's islands are formed already.
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
