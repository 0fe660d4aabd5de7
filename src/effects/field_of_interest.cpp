#include "effects/field_of_interest.h"

#include <utility>

#include "model/state.h"

namespace pbmpi::effects {

FieldOfInterest::FieldOfInterest(const model::Model& model, int iterations)
    : interest_(model.interest.value_or(model::Interest{})),
      iterations_(iterations),
      jointed_(model::jointed_bodies(model, {})),
      islands_(model.num_bodies()),
      near_(model.bodies.size(), 0),
      inside_set_(model.bodies.size(), 0) {}

void FieldOfInterest::set_broken(const model::Model& model, std::span<const std::int32_t> broken_in) {
  jointed_ = model::jointed_bodies(model, broken_in);
}

double FieldOfInterest::outside_share() const {
  constexpr double rest = 5;  // iterations that cost as much as rows and integration: Environ, sor double
  return (outside_iterations() + rest) / (iterations() + rest);
}

void FieldOfInterest::sort(std::span<const int> bodies, std::span<const core::Vec3> position,
                           std::span<const model::Contact> contacts) {
  sort_linked(bodies, position, contacts,
              [](const model::Contact& contact) { return BodyPair(contact.body_a, contact.body_b); });
}

void FieldOfInterest::sort(std::span<const int> bodies, std::span<const core::Vec3> position,
                           std::span<const BodyPair> touching) {
  sort_linked(bodies, position, touching, [](const BodyPair& pair) { return pair; });
}

template <class Links, class Pair>
void FieldOfInterest::sort_linked(std::span<const int> bodies, std::span<const core::Vec3> position,
                                  const Links& links, Pair pair_of) {
  inside_.clear();
  outside_.clear();
  inside_set_.assign(inside_set_.size(), 0);
  islands_ = jointed_;
  BodyPair before(model::no_body, model::no_body);
  for (const auto& link : links) {
    const BodyPair pair = pair_of(link);
    if (pair == before) continue;  // two bodies often have several contacts
    if (pair.first != model::no_body && pair.second != model::no_body)
      islands_.unite(pair.first, pair.second);
    before = pair;
  }
  near_.assign(near_.size(), 0);
  for (const int body : bodies) {
    if (is_near(position[static_cast<std::size_t>(body)]))
      near_[static_cast<std::size_t>(islands_.find(body))] = 1;
  }
  for (const int body : bodies) {
    const char is_inside = near_[static_cast<std::size_t>(islands_.find(body))];
    inside_set_[static_cast<std::size_t>(body)] = is_inside;
    (is_inside != 0 ? inside_ : outside_).push_back(body);
  }
}

}  // namespace pbmpi::effects
