#include "stability/guards.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "geometry/measures.h"
#include "model/joint_gap.h"

namespace pbmpi::stability {
namespace {

using model::State;
using model::Vec3;

constexpr double standard_gravity = 9.80665;  ///< [m/s^2]

int first_nonfinite(const State& state) {
  State one;
  one.resize(1);
  for (int body = 0; body < state.num_bodies(); ++body) {
    one.position[0] = state.position[body];
    one.orientation[0] = state.orientation[body];
    one.velocity[0] = state.velocity[body];
    one.angular_velocity[0] = state.angular_velocity[body];
    if (count_nonfinite(one) > 0) return body;
  }
  return model::no_body;
}

std::string number(double value, const char* unit) { return fmt::format("{:.3g}{}", value, unit); }

std::string geom_text(const model::Model& model, int geom) {
  const model::Geom& one = model.geoms[geom];
  return "'" + (one.body == model::no_body ? model.actors[one.actor].name : model.bodies[one.body].name) +
         "'";
}

std::string detail_of(const Trip& trip, const model::Model& model, const std::string& name) {
  switch (trip.guard) {
    case Guard::nonfinite:
      if (!trip.observable.empty())
        return "the observable '" + name + "' is not finite, though all bodies are,";
      return number(trip.value, trip.value > 1 ? " bodies are" : " body is") + " not finite, first '" + name +
             "'";
    case Guard::joint_gap:
      return "the joint '" + name + "' gapes by " + number(trip.value, " m, more than ") +
             number(trip.limit, " m");
    case Guard::energy_gain:
      return number(trip.value, " J were gained without a cause, more than ") + number(trip.limit, " J");
    case Guard::passage:
      if (trip.value == 0)
        return "'" + name + "' went into " + geom_text(model, trip.through) + " up to its centre";
      return "'" + name + "' went through " + geom_text(model, trip.through) + ", " +
             number(trip.value, " m beyond it");
  }
  return "";
}

}  // namespace

Guards::Guards(const model::Model& model, double dt_s, const GuardLimits& limits)
    : model_(&model), limits_(limits), energy_(model, dt_s), passages_(model) {
  const std::vector<double> sizes = geometry::sizes_of(model);
  for (const model::Joint& joint : model.joints) {
    double size = sizes[joint.body_a];
    if (joint.body_b != model::no_body) {
      const double other = sizes[joint.body_b];
      size = size > 0 && other > 0 ? std::min(size, other) : std::max(size, other);
    }
    // Bodies without geoms have no size to compare a gap with.
    gap_limit_.push_back(size > 0 ? limits.gap_share * size : model::infinity);
    least_gap_limit_ = std::min(least_gap_limit_, gap_limit_.back());
  }
  for (const model::Body& body : model.bodies) {
    lift_work_j_ += body.mass_kg * standard_gravity * limits.energy_lift_m;
    mass_kg_.push_back(body.mass_kg);
  }
}

std::optional<Trip> Guards::check(const Span& span, std::span<const Vec3> from, PassageFinder::Pace pace,
                                  model::GuardMemory& memory) const {
  const std::int64_t last_step = span.first_step + span.num_steps - 1;
  if (span.before.nonfinite > 0) return std::nullopt;  // it was reported before
  if (span.after.nonfinite > 0) {
    return Trip{.guard = Guard::nonfinite,
                .step = last_step,
                .body = first_nonfinite(span.after.state),
                .value = static_cast<double>(span.after.nonfinite)};
  }
  if (!span.after.not_finite.empty() && (span.before.not_finite.empty() || span.first_step == 0))
    return Trip{.guard = Guard::nonfinite, .step = last_step, .observable = span.after.not_finite};
  energy_.add({span.before.state, span.before.energy_j}, {span.after.state, span.after.energy_j},
              span.first_step, span.num_steps, memory);
  std::optional<Trip> trip = check_gaps(span);
  if (!trip && memory.energy_gain_j > energy_limit(memory)) {
    trip = Trip{.guard = Guard::energy_gain, .value = memory.energy_gain_j, .limit = energy_limit(memory)};
  }
  if (!trip) {
    if (const auto passed = passages_.find(span.before.state, from, span.after.state, pace)) {
      trip = Trip{
          .guard = Guard::passage, .body = passed->body, .through = passed->through, .value = passed->beyond};
    }
  }
  if (trip) trip->step = last_step;
  return trip;
}

std::optional<Trip> Guards::check_gaps(const Span& span) const {
  if (span.after.joint_gap_m <= least_gap_limit_) return std::nullopt;
  std::optional<Trip> widest;
  for (std::size_t i = 0; i < gap_limit_.size(); ++i) {
    const model::Joint& joint = model_->joints[i];
    if (span.after.state.is_broken(i)) continue;
    const double gap = joint_gap(*model_, span.after.state, joint);
    if (gap <= gap_limit_[i] || joint_gap(*model_, span.before.state, joint) > gap_limit_[i]) continue;
    if (widest && gap <= widest->value) continue;
    widest =
        Trip{.guard = Guard::joint_gap, .joint = static_cast<int>(i), .value = gap, .limit = gap_limit_[i]};
  }
  return widest;
}

std::span<const Vec3> Guards::launched(std::span<const Vec3> positions, std::int64_t first_step,
                                       int num_steps, std::vector<Vec3>& scratch) const {
  scratch.clear();
  for (const model::Event& event : events_in(*model_, first_step, num_steps)) {
    if (event.kind != model::EventKind::launch || !event.pose) continue;
    if (scratch.empty()) scratch.assign(positions.begin(), positions.end());
    scratch[static_cast<std::size_t>(event.body)] = event.pose->position;
  }
  return scratch.empty() ? positions : std::span<const Vec3>(scratch);
}

void Guards::note_kinetic(const State& state, double energy_j, model::GuardMemory& memory) const {
  Vec3 moment = Vec3::Zero();
  for (std::size_t body = 0; body < mass_kg_.size(); ++body) moment += mass_kg_[body] * state.position[body];
  const double kinetic_j = energy_j + model_->gravity.dot(moment);
  memory.largest_kinetic_j = std::max(memory.largest_kinetic_j, kinetic_j);
}

double Guards::energy_limit(const model::GuardMemory& memory) const {
  return limits_.energy_share * memory.largest_kinetic_j + lift_work_j_;
}

stepping::RunEvent event_of(const Trip& trip, int world, const model::Model& model) {
  stepping::RunEvent event;
  event.kind = stepping::event_kind::guards[static_cast<std::size_t>(trip.guard)];
  event.step = trip.step;
  event.world = world;
  event.joint = trip.joint;
  if (trip.joint >= 0) event.name = model.joints[trip.joint].name;
  if (trip.body >= 0) event.name = model.bodies[trip.body].name;
  if (!trip.observable.empty()) event.name = trip.observable;
  event.value = trip.value;
  event.detail = "world " + std::to_string(world) + ": " + detail_of(trip, model, event.name) + " in step " +
                 std::to_string(trip.step);
  return event;
}

}  // namespace pbmpi::stability
