/// What the worlds of a pack have in common.
#pragma once

#include <optional>

#include "model/model.h"

namespace pbmpi::solver {

/// The numbers that all lanes of a pack's step share. Worlds share a pack only if these are equal.
struct PackLaws {
  double erp = 0;
  double cfm = 0;
  double contact_erp = 0;
  double contact_cfm = 0;
  double bounce_velocity = 0;
  double linear_damping = 0;
  double angular_damping = 0;
  bool turning_contacts = false;          ///< Passes::turning_contacts
  std::optional<int> outside_iterations;  ///< those of the field of interest; none without a field

  bool operator==(const PackLaws&) const = default;
};

PackLaws laws_of(const model::Model& model);

}  // namespace pbmpi::solver
