#include "scenes/actors/actor.h"

#include <algorithm>

#include "model/names.h"
#include "scenes/format/shape_reader.h"

namespace pbmpi::scenes {

const std::vector<ActorType>& actor_types() {
  static const std::vector<ActorType> all = [] {
    std::vector<ActorType> types = {
        {"car", true, read_car},
        {"centipede", true, read_centipede},
        {"compound", true, read_compound},
        {"ground", false, read_ground},
        {"heightfield", false, read_height_field_actor},
        {"human", true, read_human},
        {"mesh", false, read_mesh_actor},
        {"model", true, read_model},
        {"projectile", true, read_projectile},
        {"ramp", false, read_ramp},
        {"tank", true, read_tank},
        {"wall", true, read_wall},
    };
    for (const model::Shape shape : solid_shapes())
      types.push_back({model::name_of(shape), true, read_solid});
    std::ranges::sort(types, {}, &ActorType::name);
    return types;
  }();
  return all;
}

const ActorType& read_actor_type(TableReader& actor) {
  std::vector<std::string_view> names;
  for (const ActorType& type : actor_types()) names.push_back(type.name);
  return actor_types()[actor.choice("type", names)];
}

model::Material read_material(TableReader& actor, const model::Material& fallback) {
  auto table = actor.table("material");
  if (!table) return fallback;
  model::Material material;
  material.mu = table->number("mu", Sign::non_negative, fallback.mu);
  material.restitution = table->number("restitution", Sign::non_negative, fallback.restitution);
  if (material.restitution > 1) {
    table->fail("restitution", "'restitution' must lie in [0, 1] (above 1, each bounce gains energy)");
  }
  table->finish();
  return material;
}

}  // namespace pbmpi::scenes
