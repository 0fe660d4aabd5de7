#include "solver/parts/step_islands.h"

#include <algorithm>

namespace pbmpi::solver {

StepIslands::StepIslands(const model::Model& model)
    : model_(&model), jointed_(model::jointed_bodies(model, {})), islands_(jointed_) {}

void StepIslands::connect_joints(std::span<const std::int32_t> broken_in) {
  if (std::ranges::equal(broken_in, broken_in_)) return;
  broken_in_.assign(broken_in.begin(), broken_in.end());
  jointed_ = model::jointed_bodies(*model_, broken_in);
}

void StepIslands::connect(std::span<const model::Contact> contacts, std::span<const std::int32_t> broken_in) {
  connect_joints(broken_in);
  islands_ = jointed_;
  int last_a = model::no_body, last_b = model::no_body;
  for (const model::Contact& contact : contacts) {
    if (contact.body_b == model::no_body || (contact.body_a == last_a && contact.body_b == last_b)) continue;
    islands_.unite(contact.body_a, contact.body_b);
    last_a = contact.body_a;
    last_b = contact.body_b;
  }
}

}  // namespace pbmpi::solver
