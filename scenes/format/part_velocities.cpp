#include "scenes/format/part_velocities.h"

#include "core/error.h"
#include "core/text.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {

PartVelocities::PartVelocities(TableReader& actor) {
  auto table = actor.table("parts");
  if (!table) return;
  for (const std::string& name : table->keys()) {
    auto part = table->table(name);
    parts_.push_back({name, part->where() + ": " + part->what(),
                      part->vector("velocity", Sign::any, Vec3(Vec3::Zero())),
                      part->vector("angular_velocity", Sign::any, Vec3(Vec3::Zero()))});
    part->finish();
  }
}

void PartVelocities::put_into(GrowingModel& model, const std::string& actor) const {
  for (const Part& part : parts_) {
    const std::optional<int> body = model.find_body(actor + "." + part.name);
    if (!body) {
      std::vector<std::string> names;
      for (const model::Body& one : model.bodies) {
        if (one.name.starts_with(actor + ".")) names.push_back(one.name.substr(actor.size() + 1));
      }
      throw core::InputError(part.where + ": the actor has no part " + core::in_quotes(part.name) +
                             core::suggestion(part.name, names));
    }
    model.bodies[*body].velocity = part.velocity;
    model.bodies[*body].angular_velocity = part.angular_velocity;
  }
}

}  // namespace pbmpi::scenes
