/// The scene's [interest]: where the effect "field_of_interest" wants all iterations.
#pragma once

#include <string>

#include "model/model.h"
#include "scenes/format/table_reader.h"

namespace pbmpi::scenes {

class InterestPlan {
 public:
  explicit InterestPlan(TableReader& table);

  /// Into a model with all its actors. Throws core::InputError at the name if it has none so called, or one
  /// without a body.
  void put_into(model::Model& model) const;

 private:
  int followed_body(const model::Model& model) const;

  model::Interest interest_;
  std::string follows_;  ///< an actor; none: the center stands
  std::string where_;    ///< of its name in the file
};

}  // namespace pbmpi::scenes
