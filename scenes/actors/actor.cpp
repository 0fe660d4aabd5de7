#include "scenes/actors/actor.h"

#include "core/text.h"

namespace pbmpi::scenes {

const std::vector<ActorType>& actor_types() {
  static const std::vector<ActorType> types = {
      {"box", true, read_box},           {"capsule", true, read_capsule},
      {"car", true, read_car},           {"centipede", true, read_centipede},
      {"compound", true, read_compound}, {"cylinder", true, read_cylinder},
      {"ground", false, read_ground},    {"human", true, read_human},
      {"model", true, read_model},       {"projectile", true, read_projectile},
      {"ramp", false, read_ramp},        {"sphere", true, read_sphere},
      {"tank", true, read_tank},         {"wall", true, read_wall},
  };
  return types;
}

const ActorType& read_actor_type(TableReader& actor) {
  const std::string name = actor.text("type");
  std::vector<std::string> names;
  for (const ActorType& type : actor_types()) {
    if (type.name == name) return type;
    names.emplace_back(type.name);
  }
  actor.fail("type", "unknown type " + core::in_quotes(name) + core::suggestion(name, names));
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
