#include "scenes/format/event_reader.h"

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
