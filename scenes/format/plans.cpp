#include "scenes/format/plans.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/text.h"
#include "scenes/parts/parts.h"

namespace pbmpi::scenes {
namespace {

/// A launch: a body's velocities, and its pose if the body appears elsewhere.
EventPlan read_launch(TableReader& table, model::Event event) {
  const std::string body = table.text("body"), where = table.where("body") + ": event";
  event.kind = model::EventKind::launch;
  event.velocity = table.vector("velocity", Sign::any, Vec3(Vec3::Zero()));
  event.angular_velocity = table.vector("angular_velocity", Sign::any, Vec3(Vec3::Zero()));
  if (table.has("position")) {
    event.pose = Pose{table.vector("position", Sign::any), table.rotation()};
  } else if (table.has("rotation")) {
    table.fail("rotation", "give the 'position' where the body appears, too");
  }
  return [event, body, where](GrowingModel& model) {
    model.events.push_back(event);
    model.events.back().body = model.named_body(body, where);
  };
}

EventPlan read_release(TableReader& table, model::Event event) {
  const std::string joint = table.text("release"), where = table.where("release") + ": event";
  event.kind = model::EventKind::release;
  if (event.step < 1)
    table.fail("at", "a joint can be released one step after the start at the soonest; leave it out instead");
  return [event, joint, where](GrowingModel& model) {
    model.events.push_back(event);
    model.events.back().joint = model.named_joint(joint, where);
  };
}

}  // namespace

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

PairPlan::PairPlan(TableReader& table) : where_(table.where("actors") + ": pair") {
  const std::vector<std::string> actors = table.texts("actors");
  if (actors.size() != 2) table.fail("actors", "'actors' must name two actors");
  actors_ = {actors[0], actors[1]};
  material_.mu = table.number("mu", Sign::non_negative);
  material_.restitution = table.number("restitution", Sign::non_negative, 0.0);
  if (material_.restitution > 1)
    table.fail("restitution", "'restitution' must lie in [0, 1] (above 1, each bounce gains energy)");
  table.finish();
}

void PairPlan::put_into(GrowingModel& model) const {
  const auto actors_of = [](const model::PairMaterial& one) { return std::pair(one.actor_a, one.actor_b); };
  for (const int a : model.named_actors(actors_[0], where_)) {
    for (const int b : model.named_actors(actors_[1], where_)) {
      const model::PairMaterial pair = {std::min(a, b), std::max(a, b), material_};
      std::vector<model::PairMaterial>& all = model.pair_materials;
      const auto at = std::ranges::lower_bound(all, actors_of(pair), {}, actors_of);
      if (at != all.end() && actors_of(*at) == actors_of(pair)) {
        *at = pair;
      } else {
        all.insert(at, pair);
      }
    }
  }
}

InterestPlan::InterestPlan(TableReader& table) {
  table.set_what("interest");
  if (table.has("center") == table.has("follows"))
    table.fail("follows", "give either 'center', a point, or 'follows', the name of an actor");
  if (table.has("center")) {
    interest_.center = table.vector("center", Sign::any);
  } else {
    follows_ = table.text("follows");
    where_ = table.where("follows") + ": interest";
  }
  interest_.radius_m = table.number("radius", Sign::positive);
  interest_.outside_iterations = table.integer("outside_iterations", 1, interest_.outside_iterations);
  table.finish();
}

int InterestPlan::followed_body(GrowingModel& model) const {
  const int actor = model.named_actor(follows_, where_);
  const auto first = std::ranges::find(model.bodies, actor, &model::Body::actor);
  core::require_input(first != model.bodies.end(), where_ + ": actor " + core::in_quotes(follows_) +
                                                       " has no body to follow; give a 'center'");
  return static_cast<int>(first - model.bodies.begin());
}

void InterestPlan::put_into(GrowingModel& model) const {
  model.interest = interest_;
  if (!follows_.empty()) model.interest->follows = followed_body(model);
}

EventPlan read_event(TableReader& table, double dt_s) {
  if (table.has("body") == table.has("release"))
    table.fail("body", "give either 'body', which is launched, or 'release', the name of a joint");
  model::Event event;
  event.step = step_at(table.number("at", Sign::non_negative), dt_s, table.where("at") + ": event");
  EventPlan plan = table.has("body") ? read_launch(table, event) : read_release(table, event);
  table.finish();
  return plan;
}

}  // namespace pbmpi::scenes
