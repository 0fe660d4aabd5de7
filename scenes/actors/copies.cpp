#include "scenes/actors/copies.h"

#include <string>

namespace pbmpi::scenes {
namespace {

constexpr std::int64_t most_copies = 1'000'000;  // beyond any memory

}  // namespace

Copies::Copies(TableReader& actor) : numbered_(actor.has("copies") || actor.has("places")) {
  if (actor.has("copies") && actor.has("places"))
    actor.fail("places", "give either 'copies' with their 'spacing', or 'places'");
  if (actor.has("copies")) read_rows(actor);
  if (actor.has("places")) read_places(actor);
}

void Copies::read_rows(TableReader& actor) {
  if (!actor.is_array("copies") || actor.is_nested_array("copies")) {
    count_ = WorldCount::read(actor, "copies");
    row_lengths_ = {1};
    spacings_ = {actor.vector("spacing", Sign::any)};
    return;
  }
  row_lengths_ = actor.integers("copies", 1);
  std::int64_t total = 1;
  for (const int length : row_lengths_) {
    total *= length;
    if (total > most_copies) actor.fail("copies", "'copies' are more than a million in all; place fewer");
  }
  count_ = WorldCount(static_cast<int>(total));
  spacings_ = actor.vectors("spacing", Sign::any);
  if (spacings_.size() != row_lengths_.size()) {
    actor.fail("spacing", "'spacing' must have an [x, y, z] for each number of 'copies', " +
                              std::to_string(row_lengths_.size()) + " in all");
  }
}

void Copies::read_places(TableReader& actor) {
  places_ = actor.vectors("places", Sign::any);
  count_ = WorldCount(static_cast<int>(places_.size()));
}

Vec3 Copies::offset(int copy) const {
  if (!places_.empty()) return places_[static_cast<std::size_t>(copy)];
  Vec3 offset = Vec3::Zero();
  for (std::size_t i = 0; i < spacings_.size(); ++i) {
    const bool is_outermost = i + 1 == spacings_.size();
    offset += (is_outermost ? copy : copy % row_lengths_[i]) * spacings_[i];
    copy /= row_lengths_[i];
  }
  return offset;
}

}  // namespace pbmpi::scenes
