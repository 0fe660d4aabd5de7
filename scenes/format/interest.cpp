#include "scenes/format/interest.h"

#include <algorithm>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::scenes {

InterestPlan::InterestPlan(TableReader& table) {
  table.set_what("interest");
  if (table.has("center") == table.has("follows"))
    table.fail("follows", "give either 'center', a point, or 'follows', the name of an actor");
  if (table.has("center")) {
    interest_.center = table.vector("center", Sign::any);
  } else {
    follows_ = table.text("follows");
    where_ = table.where("follows") + ": interest";
  }
  interest_.radius_m = table.number("radius", Sign::positive);
  interest_.outside_iterations = table.integer("outside_iterations", 1, interest_.outside_iterations);
  table.finish();
}

int InterestPlan::followed_body(GrowingModel& model) const {
  const int actor = model.named_actor(follows_, where_);
  const auto first = std::ranges::find(model.bodies, actor, &model::Body::actor);
  core::require_input(first != model.bodies.end(), where_ + ": actor " + core::in_quotes(follows_) +
                                                       " has no body to follow; give a 'center'");
  return static_cast<int>(first - model.bodies.begin());
}

void InterestPlan::put_into(GrowingModel& model) const {
  model.interest = interest_;
  if (!follows_.empty()) model.interest->follows = followed_body(model);
}

}  // namespace pbmpi::scenes
