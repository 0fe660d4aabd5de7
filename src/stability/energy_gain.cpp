#include "stability/energy_gain.h"

#include <algorithm>

#include "model/mechanics.h"
#include "stability/events_in.h"

namespace pbmpi::stability {
namespace {

using model::Event;
using model::EventKind;
using model::Model;
using model::State;

/// Energy of launched bodies after their launches, minus the least energy that they can have had before.
double launch_work(const Model& model, const State& before, std::int64_t first_step, int num_steps) {
  double work = 0;
  State launched;
  for (const Event& event : events_in(model, first_step, num_steps)) {
    if (event.kind != EventKind::launch) continue;
    if (launched.position.empty()) launched = before;
    const int body = event.body;
    const double had = body_energy(model, launched, body);
    launched.velocity[body].setZero();
    launched.angular_velocity[body].setZero();
    const double had_at_rest = body_energy(model, launched, body);
    if (event.pose) {
      launched.position[body] = event.pose->position;
      launched.orientation[body] = event.pose->orientation;
    }
    launched.velocity[body] = event.velocity;
    launched.angular_velocity[body] = event.angular_velocity;
    // The body may have lost its speed in the steps before a later launch.
    const double least = event.step == first_step ? had : std::min(had, had_at_rest);
    work += body_energy(model, launched, body) - least;
  }
  return work;
}

}  // namespace

double spring_energy(const Model& model, const State& state) {
  double energy = 0;
  for (const Suspension& spring : suspensions_of(model)) energy += energy_of(spring, state);
  return energy;
}

double allowed_work(const Model& model, const State& before, const State& after, std::int64_t first_step,
                    int num_steps, double dt_s) {
  return DriveWork(model, dt_s).most(before, after, first_step, num_steps) +
         launch_work(model, before, first_step, num_steps) + spring_energy(model, before) -
         spring_energy(model, after);
}

EnergyGain::EnergyGain(const Model& model, double dt_s)
    : model_(&model), drives_(model, dt_s), springs_(suspensions_of(model)) {}

void EnergyGain::add(const At& before, const At& after, std::int64_t first_step, int num_steps,
                     model::GuardMemory& memory) const {
  double change = after.energy_j - before.energy_j;
  for (const Suspension& spring : springs_)
    change += energy_of(spring, after.state) - energy_of(spring, before.state);
  change -= launch_work(*model_, before.state, first_step, num_steps);
  if (change <= 0 && memory.energy_gain_j == 0) return;
  change -= drives_.most(before.state, after.state, first_step, num_steps);
  memory.energy_gain_j = std::max(0.0, memory.energy_gain_j + change);
}

}  // namespace pbmpi::stability
