#include "stability/cases/case_watch.h"

#include <algorithm>
#include <cmath>

#include "analysis/pose_errors.h"
#include "core/error.h"
#include "geometry/geometry.h"
#include "model/joint_gap.h"

namespace pbmpi::stability {
namespace {

using model::State;
using model::Vec3;

std::vector<int> watched_bodies(const HardCase& hard_case, const model::Model& model) {
  std::vector<int> watched;
  for (int body = 0; body < model.num_bodies(); ++body) {
    const std::string& name = model.bodies[static_cast<std::size_t>(body)].name;
    const auto begins = [&](const std::string& beginning) { return name.starts_with(beginning); };
    if (hard_case.watch.empty() || std::ranges::any_of(hard_case.watch, begins)) watched.push_back(body);
  }
  core::require_input(!watched.empty() || model.bodies.empty(),
                      "[case] watch: no body's name begins so; name bodies of the scene");
  return watched;
}

int named_body(const model::Model& model, const std::string& name) {
  const auto found = std::ranges::find(model.bodies, name, &model::Body::name);
  core::require_input(found != model.bodies.end(),
                      "[[case.expect]] body '" + name + "': the scene has no such body");
  return static_cast<int>(found - model.bodies.begin());
}

Vec3 centre_of_mass(const model::Model& model, const State& state) {
  Vec3 sum = Vec3::Zero();
  double mass_kg = 0;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    sum += model.bodies[i].mass_kg * state.position[i];
    mass_kg += model.bodies[i].mass_kg;
  }
  return mass_kg > 0 ? Vec3(sum / mass_kg) : sum;
}

/// Angular momentum about the centre of mass of all bodies.
Vec3 spin(const model::Model& model, const model::Mechanics& mechanics, const State& state) {
  return mechanics.angular_momentum - centre_of_mass(model, state).cross(mechanics.linear_momentum);
}

double quantity_of(const Expectation& expected, const State& start, const State& state, std::size_t body) {
  const Vec3 &at = state.position[body], &velocity = state.velocity[body];
  switch (expected.quantity) {
    case Quantity::x:
      return at.x();
    case Quantity::y:
      return at.y();
    case Quantity::z:
      return at.z();
    case Quantity::vx:
      return velocity.x();
    case Quantity::vy:
      return velocity.y();
    case Quantity::vz:
      return velocity.z();
    case Quantity::speed:
      return velocity.norm();
    case Quantity::way:
      return (at - start.position[body]).norm();
    case Quantity::turn:
      return analysis::rotation_angle(state.orientation[body], start.orientation[body]);
  }
  return NAN;
}

double share(double part, double whole) { return whole > 0 ? part / whole : (part > 0 ? INFINITY : 0); }

}  // namespace

CaseWatch::CaseWatch(const HardCase& hard_case, const model::Model& model, double dt_s)
    : case_(&hard_case),
      model_(&model),
      dt_s_(dt_s),
      watched_(watched_bodies(hard_case, model)),
      start_(model::initial_state(model)),
      before_(start_),
      energy_gain_(model, dt_s),
      mechanics_(model) {
  for (const Expectation& expected : case_->expectations)
    expected_body_.push_back(named_body(model, expected.body));
  now_.expected_off.assign(case_->expectations.size(), NAN);
  const model::Mechanics mechanics = mechanics_.measure(start_);
  start_energy_j_ = energy_j_ = mechanics.energy_j;
  start_momentum_ = mechanics.linear_momentum;
  start_spin_ = spin(model, mechanics, start_);
  spin_scale_ = start_spin_.norm();
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    momentum_scale_ += model.bodies[i].mass_kg * start_.velocity[i].norm();
}

void CaseWatch::raise(Metric metric, double value) {
  double& most = now_.metrics[static_cast<std::size_t>(metric)];
  most = std::isnan(value) ? INFINITY : std::max(most, value);
}

void CaseWatch::see(const State& state, const stepping::Observables& seen, std::int64_t step) {
  const double time_s = static_cast<double>(step) * dt_s_;
  raise(Metric::nonfinite, seen.nonfinite);
  if (before_step_ > 0) raise(Metric::penetration, seen.max_penetration_m);
  see_joints(state);
  see_bodies(state, time_s);
  const model::Mechanics mechanics = mechanics_.measure(state);
  see_energy(state, mechanics.energy_j, step);
  see_momentum(state, mechanics);
  see_expected(state, time_s);
  before_ = state;
  before_step_ = step;
  now_.simulated_s = time_s;
  note_broken(time_s);
}

void CaseWatch::see_joints(const State& state) {
  for (std::size_t i = 0; i < model_->joints.size(); ++i) {
    if (state.is_broken(i)) continue;
    const double gap_m = model::joint_gap(*model_, state, model_->joints[i]);
    raise(Metric::joint_gap, gap_m);
    sum_of_squared_gaps_ += gap_m * gap_m;
    ++num_gaps_;
  }
  if (num_gaps_ > 0) {
    now_.metrics[static_cast<std::size_t>(Metric::joint_gap_rms)] =
        std::sqrt(sum_of_squared_gaps_ / static_cast<double>(num_gaps_));
  }
}

void CaseWatch::see_bodies(const State& state, double time_s) {
  int escaped = 0;
  for (int body = 0; body < model_->num_bodies(); ++body) {
    const Vec3& at = state.position[static_cast<std::size_t>(body)];
    const bool inside =
        (at.array() >= case_->region.low.array()).all() && (at.array() <= case_->region.high.array()).all();
    if (!inside) ++escaped;
  }
  raise(Metric::escaped, escaped);
  if (!halfway_ && time_s >= case_->seconds / 2) {
    halfway_ = state;
    halfway_s_ = time_s;
  }
  double creep = 0;
  for (const int body : watched_) {
    const auto i = static_cast<std::size_t>(body);
    const Vec3 way = state.position[i] - start_.position[i];
    raise(Metric::drift, way.norm());
    raise(Metric::sink, std::isnan(way.z()) ? NAN : std::max(0.0, -way.z()));
    if (time_s >= case_->settle_s) raise(Metric::speed, state.velocity[i].norm());
    if (time_s > halfway_s_ && halfway_)
      creep = std::max(creep, (state.position[i] - halfway_->position[i]).norm() / (time_s - halfway_s_));
  }
  now_.metrics[static_cast<std::size_t>(Metric::creep)] = creep;
}

void CaseWatch::see_energy(const State& state, double energy_j, std::int64_t step) {
  energy_gain_.add({before_, energy_j_}, {state, energy_j}, before_step_,
                   static_cast<int>(step - before_step_), memory_);
  energy_j_ = energy_j;
  raise(Metric::energy_gain, std::isfinite(energy_j) ? memory_.energy_gain_j : NAN);
  raise(Metric::energy_change, share(std::abs(energy_j - start_energy_j_), std::abs(start_energy_j_)));
}

void CaseWatch::see_momentum(const State& state, const model::Mechanics& mechanics) {
  raise(Metric::linear_momentum,
        share((mechanics.linear_momentum - start_momentum_).norm(), momentum_scale_));
  raise(Metric::angular_momentum, share((spin(*model_, mechanics, state) - start_spin_).norm(), spin_scale_));
}

void CaseWatch::see_expected(const State& state, double time_s) {
  for (std::size_t i = 0; i < expected_body_.size(); ++i) {
    const Expectation& expected = case_->expectations[i];
    const bool is_taken = !std::isnan(now_.expected_off[i]);
    if (is_taken || time_s < expected.at_s - dt_s_ / 2) continue;
    const auto body = static_cast<std::size_t>(expected_body_[i]);
    now_.expected_off[i] = std::abs(quantity_of(expected, start_, state, body) - expected.value);
  }
}

void CaseWatch::note_broken(double time_s) {
  if (std::isfinite(now_.broken_at_s)) return;
  for (const Bound& bound : case_->bounds) {
    if (bound.metric != Metric::creep && !(metric(bound.metric) <= bound.limits.broken))
      now_.broken_at_s = time_s;
  }
}

}  // namespace pbmpi::stability
