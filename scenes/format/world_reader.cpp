#include "scenes/format/world_reader.h"

#include <set>
#include <string>

namespace pbmpi::scenes {
namespace {

void read_contact_law(TableReader& scene, model::ContactLaw& law) {
  auto contact = scene.table("contact");
  if (!contact) return;
  law.soft_erp = contact->number("soft_erp", Sign::non_negative, law.soft_erp);
  if (law.soft_erp > 1) contact->fail("soft_erp", "'soft_erp' must lie in [0, 1]");
  law.soft_cfm = contact->number("soft_cfm", Sign::non_negative, law.soft_cfm);
  law.bounce_velocity = contact->number("bounce_velocity", Sign::non_negative, law.bounce_velocity);
  law.max_per_pair = contact->integer("max_per_pair", 1, law.max_per_pair);
  contact->finish();
}

void read_sleep(TableReader& scene, model::SleepRule& rule) {
  auto sleep = scene.table("sleep");
  if (!sleep) return;
  rule.speed = sleep->number("speed", Sign::non_negative, rule.speed);
  rule.angular_speed = sleep->number("angular_speed", Sign::non_negative, rule.angular_speed);
  rule.after_s = sleep->number("after", Sign::positive, rule.after_s);
  sleep->finish();
}

void read_spaces(TableReader& scene, model::Model& world) {
  if (scene.has("spaces")) world.spaces = scene.texts("spaces");
  if (world.spaces.empty()) scene.fail("spaces", "'spaces' is empty; name at least one");
  if (std::set<std::string>(world.spaces.begin(), world.spaces.end()).size() != world.spaces.size())
    scene.fail("spaces", "'spaces' names one space twice");
  const std::string meet = scene.text("inter_space", "any");
  if (meet != "any" && meet != "none") scene.fail("inter_space", "'inter_space' must be \"any\" or \"none\"");
  world.spaces_meet = meet == "any";
}

}  // namespace

void read_world(TableReader& scene, model::Model& world) {
  world.gravity = scene.vector("gravity", Sign::any, world.gravity);
  world.erp = scene.number("erp", Sign::non_negative, world.erp);
  if (world.erp > 1) scene.fail("erp", "'erp' is a share of the error and must lie in [0, 1]");
  world.cfm = scene.number("cfm", Sign::non_negative, world.cfm);
  world.linear_damping = scene.number("linear_damping", Sign::non_negative, world.linear_damping);
  world.angular_damping = scene.number("angular_damping", Sign::non_negative, world.angular_damping);
  if (auto air = scene.table("air")) {
    world.air_density = air->number("density", Sign::non_negative, world.air_density);
    air->finish();
  }
  read_contact_law(scene, world.contact_law);
  read_sleep(scene, world.sleep);
  read_spaces(scene, world);
}

}  // namespace pbmpi::scenes
