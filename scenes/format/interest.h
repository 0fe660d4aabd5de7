/// The scene's [interest]: where the effect "field_of_interest" wants all iterations.
#pragma once

#include <string>

#include "scenes/format/table_reader.h"
#include "scenes/parts/growing_model.h"

namespace pbmpi::scenes {

class InterestPlan {
 public:
  explicit InterestPlan(TableReader& table);

  /// Puts the field of interest into a model that has all its actors. Throws core::InputError at the name if
  /// no actor has that name, or if that actor has no body.
  void put_into(GrowingModel& model) const;

 private:
  int followed_body(GrowingModel& model) const;

  model::Interest interest_;
  std::string follows_;  ///< an actor; empty: the center is fixed
  std::string where_;    ///< place of its name in the file, and "interest"
};

}  // namespace pbmpi::scenes
