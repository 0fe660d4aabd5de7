#include "scenes/actors/variation.h"

#include <cmath>
#include <string>

#include "core/random.h"
#include "core/text.h"

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

Variation read_variation(TableReader& actor) {
  Variation result;
  if (auto table = actor.table("variation")) {
    result.position = table->vector("position", Sign::non_negative, Vec3(Vec3::Zero()));
    result.velocity = table->vector("velocity", Sign::non_negative, Vec3(Vec3::Zero()));
    result.heading_deg = table->number("heading", Sign::non_negative, 0.0);
    table->finish();
  }
  return result;
}

Offset draw(const Variation& variation, std::uint64_t seed, int world, std::uint64_t actor) {
  // Each actor has 16 numbers reserved, so a new kind of variation does not shift the old draws.
  std::uint64_t index = 16 * actor;
  const auto uniform = [&](double half_width) {
    const auto bits = core::mix_key(seed, static_cast<std::uint64_t>(world), index++);
    return half_width * (2 * core::to_unit(bits) - 1);
  };
  Offset offset;
  for (int i = 0; i < 3; ++i) offset.position[i] = uniform(variation.position[i]);
  for (int i = 0; i < 3; ++i) offset.velocity[i] = uniform(variation.velocity[i]);
  offset.heading_deg = uniform(variation.heading_deg);
  return offset;
}

WorldCount WorldCount::read(TableReader& table, std::string_view key) {
  WorldCount result;
  if (!table.has(key)) return result;
  constexpr double most = 1e6;  // worlds or copies: beyond any memory
  if (!table.is_array(key)) {
    const int count = table.integer(key, 1);
    if (count > most) table.fail(key, core::in_quotes(key) + " is at most a million");
    return WorldCount(count);
  }
  result.steps_.clear();
  for (const auto& [world, count] : table.ascending_pairs(key)) {
    if (world != std::floor(world) || count != std::floor(count) || count < 1 || world > most ||
        count > most) {
      table.fail(key, core::in_quotes(key) +
                          " needs pairs of whole numbers [first world, number >= 1] up to a million");
    }
    result.steps_.push_back({static_cast<int>(world), static_cast<int>(count)});
  }
  if (result.steps_.front()[0] != 0) table.fail(key, "the first pair must begin at world 0");
  return result;
}

int WorldCount::in(int world) const {
  int count = steps_.front()[1];
  for (const auto& [first, value] : steps_) {
    if (world >= first) count = value;
  }
  return count;
}

}  // namespace pbmpi::scenes
