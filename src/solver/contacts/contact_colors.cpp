#include "solver/contacts/contact_colors.h"

#include <algorithm>
#include <bit>

#include "model/model.h"

namespace pbmpi::solver {

namespace {
constexpr int num_mask_colors = 64;
}

void ContactColors::start(int num_bodies) {
  used_.assign(static_cast<std::size_t>(num_bodies), 0);
  next_.clear();
}

int ContactColors::paint(int body_a, int body_b) {
  const auto a = static_cast<std::size_t>(body_a);
  const auto b = body_b == model::no_body ? a : static_cast<std::size_t>(body_b);
  int color = std::countr_one(used_[a] | used_[b]);
  if (color < num_mask_colors) {
    used_[a] |= 1ull << color;
    used_[b] |= 1ull << color;
  } else {  // a body with more than 64 contacts: each further one gets a new colour
    if (next_.empty()) next_.assign(used_.size(), num_mask_colors);
    color = std::max(next_[a], next_[b]);
    next_[a] = next_[b] = color + 1;
  }
  return color;
}

}  // namespace pbmpi::solver
