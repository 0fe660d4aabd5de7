#include "scenes/actors/variation.h"

#include <cmath>

#include "core/random.h"
#include "core/text.h"

namespace pbmpi::scenes {

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
