#include "api/world_set.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>

#include "api/version.h"
#include "api/world_layout.h"
#include "core/error.h"
#include "core/text.h"
#include "effects/motors.h"
#include "effects/sleepers.h"
#include "engines/stepper_factory.h"
#include "model/joint_traits.h"
#include "model/mechanics.h"
#include "mpi/balance/partition.h"
#include "mpi/comm/agreement.h"
#include "mpi/frame/frame_driver.h"
#include "mpi/frame/whole_state.h"
#include "stepping/observable_table.h"

namespace pbmpi::api {
namespace {

constexpr double unaimed = std::numeric_limits<double>::quiet_NaN();

mpi::Communicator communicator_of(const BatchOptions& options) {
  return options.communicator ? mpi::Communicator::dup_of(*options.communicator) : mpi::Communicator();
}

/// The worlds of this rank, ascending.
std::vector<int> own_worlds(const mpi::Communicator& comm, int num_worlds) {
  const mpi::Placement placement = mpi::equal_placement(num_worlds, comm.size());
  std::vector<int> own;
  for (int world = 0; world < num_worlds; ++world) {
    if (placement[static_cast<std::size_t>(world)] == comm.rank()) own.push_back(world);
  }
  return own;
}

/// The parameters with which world `world` begins.
Parameters parameters_of(const BatchOptions& options, int world) {
  return options.parameters.empty() ? Parameters{} : options.parameters[static_cast<std::size_t>(world)];
}

/// Throws unless there are as many numbers as the lengths say, or none, and all are finite.
void require_numbers(std::span<const double> values, const std::string& name,
                     std::initializer_list<std::size_t> lengths) {
  std::size_t count = 1;
  std::string shape;
  for (const std::size_t length : lengths) {
    count *= length;
    shape += "[" + std::to_string(length) + "]";
  }
  core::require_input(values.empty() || values.size() == count,
                      name + " has " + std::to_string(values.size()) + " numbers, and " + shape + " are " +
                          std::to_string(count) + "; give each its own, or none");
  core::require_input(std::ranges::all_of(values, [](double value) { return std::isfinite(value); }),
                      name + " has a number that is not finite; give finite ones");
}

/// Forces and torques one after the other, and back.
std::vector<double> numbers_of(const std::vector<stepping::BodyLoad>& loads) {
  std::vector<double> numbers;
  numbers.reserve(6 * loads.size());
  for (const stepping::BodyLoad& load : loads) {
    numbers.insert(numbers.end(), load.force.begin(), load.force.end());
    numbers.insert(numbers.end(), load.torque.begin(), load.torque.end());
  }
  return numbers;
}

std::vector<stepping::BodyLoad> loads_of(const std::vector<double>& numbers) {
  std::vector<stepping::BodyLoad> loads(numbers.size() / 6);
  for (std::size_t i = 0; i < loads.size(); ++i)
    loads[i] = {model::Vec3(numbers.data() + 6 * i), model::Vec3(numbers.data() + 6 * i + 3)};
  return loads;
}

void require_mask(std::span<const bool> mask, std::size_t num_worlds) {
  core::require_input(mask.empty() || mask.size() == num_worlds,
                      "the mask has " + std::to_string(mask.size()) + " entries, and this rank has " +
                          std::to_string(num_worlds) + " worlds; give an entry for each, or none at all");
}

bool chosen(std::span<const bool> mask, std::size_t index) { return mask.empty() || mask[index]; }

/// Throws unless every sleeping body of the state sleeps in an island that the world has.
void require_islands(int world, const model::State& state) {
  const bool fit = std::all_of(state.rest.begin(), state.rest.end(), [&](const model::Rest& rest) {
    return rest.idle_steps >= -static_cast<std::int32_t>(state.rest.size());
  });
  core::require_input(fit, "in saved world " + std::to_string(world) +
                               " a body sleeps in an island that it does not have; the worlds are damaged");
}

}  // namespace

WorldSet::WorldSet(const BatchOptions& options)
    : comm_(communicator_of(options)),
      recipe_(comm_, options),
      ids_(own_worlds(comm_, recipe_.num_worlds())),
      first_parameters_(parameters_of(options, 0)),
      first_world_(mpi::agree_on_errors(comm_,
                                        [&] {
                                          return recipe_.build(0, {options.seed, first_parameters_});
                                        })),
      layout_(*first_world_),
      steps_(num_worlds(), 0),
      steppers_(make_steppers()),
      arrays_(make_arrays(static_cast<int>(num_worlds()), layout_.num_bodies())) {
  mpi::agree_on_errors(comm_, [&] {
    for (const int id : ids_) {
      worlds_.push_back(build(id, {options.seed, parameters_of(options, id)}));
      const World& world = worlds_.back();
      steppers_.add(id, solver_seed(world.from), world.model, model::initial_state(*world.model), 0);
    }
  });
}

SeededSteppers WorldSet::make_steppers() const {
  return SeededSteppers([this](std::uint64_t seed) {
    stepping::StepperSettings settings = recipe_.settings(seed);
    settings.seed = seed;
    return engines::make_stepper(settings);
  });
}

WorldSet::World WorldSet::build(int id, WorldSeed from) const {
  World world;
  if (recipe_.is_uniform() && from.parameters.empty() && first_parameters_.empty()) {
    world.model = first_world_;
  } else {
    world.model = recipe_.build(id, from);
    layout_.require_same(id, *world.model);
  }
  world.from = std::move(from);
  world.aims = no_aims();
  return world;
}

WorldSet::Aims WorldSet::no_aims() const {
  const auto num_motors = static_cast<std::size_t>(layout_.num_motors());
  return {std::vector<double>(num_motors, unaimed), std::vector<std::int64_t>(num_motors, 0)};
}

void WorldSet::step(int num_steps) {
  core::require_input(num_steps >= 0,
                      "a batch cannot do " + std::to_string(num_steps) + " steps; ask for 0 or more");
  if (num_steps == 0 || ids_.empty()) return;
  make_old();
  if (has_efforts()) {
    for (int step = 0; step < num_steps; ++step) {
      for (std::size_t i = 0; i < num_worlds(); ++i) push(i);
      steppers_.advance(1);
    }
  } else {
    steppers_.advance(num_steps);
  }
  for (std::int64_t& step : steps_) step += num_steps;
  for (World& world : worlds_) world.measured = true;
}

const BatchState& WorldSet::state() {
  if (!std::exchange(arrays_are_old_, false)) return arrays_;
  for (std::size_t i = 0; i < num_worlds(); ++i) put(state_of(i), static_cast<int>(i), arrays_);
  return arrays_;
}

void WorldSet::set_state(const BatchState& state, std::span<const bool> mask) {
  require_mask(mask, num_worlds());
  require_shape(state, static_cast<int>(num_worlds()), layout_.num_bodies());
  std::vector<std::pair<std::size_t, model::State>> changed;
  for (std::size_t i = 0; i < num_worlds(); ++i) {
    if (!chosen(mask, i)) continue;
    changed.emplace_back(i, state_of(i));
    model::State& wanted = changed.back().second;
    take(state, static_cast<int>(i), ids_[i], *worlds_[i].model, wanted);
    effects::Sleepers::wake_in(wanted, effects::Sleepers::islands_moved(state_of(i), wanted));
  }
  for (const auto& [index, wanted] : changed) {
    steppers_.of(ids_[index]).set_state(ids_[index], wanted, steps_[index]);
    worlds_[index].measured = false;
  }
  make_old();
}

void WorldSet::reset(std::span<const bool> mask, std::uint64_t seed, std::span<const Parameters> parameters) {
  require_mask(mask, num_worlds());
  core::require_input(parameters.empty() || parameters.size() == num_worlds(),
                      "there are parameters of " + std::to_string(parameters.size()) +
                          " worlds, and this rank has " + std::to_string(num_worlds()) +
                          "; give each world its own, or none");
  std::vector<std::pair<std::size_t, World>> fresh;
  for (std::size_t i = 0; i < num_worlds(); ++i) {
    if (!chosen(mask, i)) continue;
    const WorldSeed from{seed, parameters.empty() ? worlds_[i].from.parameters : parameters[i]};
    if (from == worlds_[i].from) {
      fresh.emplace_back(i, World{from, worlds_[i].model, no_aims()});
    } else {
      fresh.emplace_back(i, build(ids_[i], from));
    }
  }
  for (auto& [index, world] : fresh) {
    steppers_.remove(ids_[index]);
    steppers_.add(ids_[index], solver_seed(world.from), world.model, model::initial_state(*world.model), 0);
    steps_[index] = 0;
    worlds_[index] = std::move(world);
  }
  make_old();
}

void WorldSet::aim(std::size_t index, std::size_t motor, double velocity) {
  const analysis::JointAxis& axis = layout_.axes()[motor];
  steppers_.of(ids_[index]).set_motor_velocity(ids_[index], axis.joint, axis.axis, velocity);
  worlds_[index].aims.velocity[motor] = velocity;
  worlds_[index].aims.since[motor] = steps_[index];
}

void WorldSet::aim_all(std::span<const double> velocities, const std::string& what) {
  const auto num_motors = static_cast<std::size_t>(layout_.num_motors());
  core::require_input(velocities.size() == num_worlds() * num_motors,
                      "there are " + std::to_string(velocities.size()) + " " + what + ", and [" +
                          std::to_string(num_worlds()) + "][" + std::to_string(num_motors) + "] motors");
  core::require_input(
      std::none_of(velocities.begin(), velocities.end(), [](double v) { return std::isinf(v); }),
      "a motor cannot aim at infinite " + what +
          "; give finite ones, or NaN for the motors that stay as they are");
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    if (!std::isnan(velocities[i])) aim(i / num_motors, i % num_motors, velocities[i]);
  }
}

void WorldSet::set_motor_velocities(std::span<const double> velocities) { aim_all(velocities, "velocities"); }

void WorldSet::set_targets(std::span<const double> positions) {
  const auto num_motors = static_cast<std::size_t>(layout_.num_motors());
  std::vector<double> velocities(positions.begin(), positions.end());
  for (std::size_t i = 0; i < std::min(velocities.size(), num_worlds() * num_motors); ++i) {
    if (!std::isnan(velocities[i])) velocities[i] *= hold_rate(i / num_motors, i % num_motors);
  }
  aim_all(velocities, "targets");
}

double WorldSet::hold_rate(std::size_t index, std::size_t motor) const {
  const analysis::JointAxis& at = layout_.axes()[motor];
  const double rate =
      effects::motor_before(*worlds_[index].model, steps_[index], at.joint, at.axis).hold_rate;
  core::require_input(rate > 0, "the motor " + core::in_quotes(layout_.motors()[motor].name) +
                                    " holds no pose; give it a hold_rate (a position servo of MJCF has one), "
                                    "or NaN as its target");
  return std::min(rate, 1 / dt_s());  // as a step uses it
}

const BatchJoints& WorldSet::joints() {
  if (!std::exchange(joints_are_old_, false)) return joints_;
  const std::size_t num_axes = layout_.joint_axes().size();
  joints_.position.resize(num_worlds() * num_axes);
  joints_.velocity.resize(num_worlds() * num_axes);
  for (std::size_t i = 0; i < num_worlds(); ++i) {
    World& world = worlds_[i];
    if (!world.coordinates) world.coordinates = std::make_shared<analysis::JointCoordinates>(*world.model);
    const model::State& state = state_of(i);
    world.coordinates->measure(state, std::span(joints_.position).subspan(i * num_axes, num_axes));
    for (std::size_t k = 0; k < num_axes; ++k) {
      const auto [joint, axis] = world.coordinates->axes()[k];
      joints_.velocity[i * num_axes + k] =
          model::axis_speed(state, world.model->joints[static_cast<std::size_t>(joint)], axis);
    }
  }
  return joints_;
}

void WorldSet::require_loads() const {
  core::require_input(recipe_.settings(0).kind == stepping::StepperKind::sor,
                      "only the stepper sor takes forces and efforts from outside; make the batch with it");
}

void WorldSet::set_forces(std::span<const double> forces, std::span<const double> torques) {
  require_loads();
  const auto num_bodies = static_cast<std::size_t>(layout_.num_bodies());
  const auto require = [&](std::span<const double> values, const std::string& name) {
    require_numbers(values, name, {num_worlds(), num_bodies, 3});
  };
  require(forces, "forces");
  require(torques, "torques");
  const auto vector_at = [](std::span<const double> values, std::size_t at) {
    return values.empty() ? model::Vec3(model::Vec3::Zero())
                          : model::Vec3(values[3 * at], values[3 * at + 1], values[3 * at + 2]);
  };
  for (std::size_t i = 0; i < num_worlds(); ++i) {
    std::vector<stepping::BodyLoad>& loads = worlds_[i].loads;
    loads.resize(num_bodies);
    for (std::size_t body = 0; body < num_bodies; ++body)
      loads[body] = {vector_at(forces, i * num_bodies + body), vector_at(torques, i * num_bodies + body)};
    push(i);
  }
}

void WorldSet::set_efforts(std::span<const double> efforts) {
  require_loads();
  const std::size_t num_axes = layout_.joint_axes().size();
  require_numbers(efforts, "efforts", {num_worlds(), num_axes});
  for (std::size_t i = 0; i < num_worlds(); ++i) {
    const auto own = efforts.empty() ? efforts : efforts.subspan(i * num_axes, num_axes);
    worlds_[i].efforts.assign(own.begin(), own.end());
    push(i);
  }
}

bool WorldSet::has_efforts() const {
  return std::ranges::any_of(worlds_, [](const World& world) {
    return std::ranges::any_of(world.efforts, [](double effort) { return effort != 0; });
  });
}

/// A slider's bodies push each other midway between their centres.
std::vector<stepping::BodyLoad> WorldSet::loads_now(std::size_t index) const {
  const World& world = worlds_[index];
  const model::State& state = state_of(index);
  std::vector<stepping::BodyLoad> loads = world.loads;
  loads.resize(static_cast<std::size_t>(layout_.num_bodies()));
  const std::vector<analysis::JointAxis> axes =
      world.efforts.empty() ? std::vector<analysis::JointAxis>{} : analysis::axes_of(*world.model);
  for (std::size_t k = 0; k < axes.size(); ++k) {
    const auto joint_index = static_cast<std::size_t>(axes[k].joint);
    if (world.efforts[k] == 0 || state.is_broken(joint_index)) continue;
    const model::Joint& joint = world.model->joints[joint_index];
    const model::Vec3 effort = world.efforts[k] * analysis::axis_direction(state, joint, axes[k].axis);
    const auto a = static_cast<std::size_t>(joint.body_a), b = static_cast<std::size_t>(joint.body_b);
    const bool has_b = joint.body_b != model::no_body;
    if (model::traits_of(joint.kind).slides) {
      const model::Vec3 arm =
          has_b ? model::Vec3((state.position[b] - state.position[a]) / 2) : model::Vec3(model::Vec3::Zero());
      loads[a].force += effort;
      loads[a].torque += arm.cross(effort);
      if (has_b) loads[b].force -= effort;
      if (has_b) loads[b].torque += arm.cross(effort);
    } else {
      loads[a].torque += effort;
      if (has_b) loads[b].torque -= effort;
    }
  }
  return loads;
}

void WorldSet::push(std::size_t index) {
  const std::vector<stepping::BodyLoad> loads = loads_now(index);
  for (std::size_t body = 0; body < loads.size(); ++body)
    steppers_.of(ids_[index]).set_load(ids_[index], static_cast<int>(body), loads[body]);
}

double WorldSet::aim_now(std::size_t index, std::size_t motor) const {
  const analysis::JointAxis& axis = layout_.axes()[motor];
  const Aims& aims = worlds_[index].aims;
  if (std::isnan(aims.velocity[motor])) return unaimed;
  const auto& events = worlds_[index].model->events;
  const bool ended = std::any_of(events.begin(), events.end(), [&](const model::Event& event) {
    return event.kind == model::EventKind::motor && event.joint == axis.joint && event.axis == axis.axis &&
           event.step >= aims.since[motor] && event.step < steps_[index];
  });
  return ended ? unaimed : aims.velocity[motor];
}

stepping::Observables WorldSet::observables_of(std::size_t index) const {
  if (worlds_[index].measured) return steppers_.of(ids_[index]).observables(ids_[index]);
  stepping::Observables seen;
  stepping::observe_state(*worlds_[index].model, state_of(index), seen);
  return seen;
}

std::vector<std::string> WorldSet::observable_names() {
  std::vector<std::string> names;
  names.reserve(stepping::world_observables.size());
  for (const stepping::WorldColumn& column : stepping::world_observables) names.emplace_back(column.name);
  return names;
}

std::vector<double> WorldSet::observable(std::string_view name) const {
  const auto& columns = stepping::world_observables;
  const auto column =
      std::find_if(columns.begin(), columns.end(), [&](const auto& c) { return c.name == name; });
  if (column == columns.end()) {
    throw core::InputError("there is no observable " + core::in_quotes(name) +
                           core::suggestion(name, observable_names()));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < num_worlds(); ++i) {
    const stepping::Observables seen = observables_of(i);
    stepping::with_member(*column, [&](auto member) {
      if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(seen.*member)>>) {
        values.push_back(seen.*member);
      } else {
        values.insert(values.end(), (seen.*member).begin(), (seen.*member).end());
      }
    });
  }
  return values;
}

SavedFrom WorldSet::saved_from() const {
  return {library_version, recipe_.scene_name(), recipe_.scene_checksum(), recipe_.settings_checksum()};
}

std::vector<std::byte> WorldSet::save() const {
  std::vector<SavedWorld> saved;
  for (std::size_t i = 0; i < num_worlds(); ++i) {
    std::vector<double> aims;
    for (std::size_t motor = 0; motor < worlds_[i].aims.velocity.size(); ++motor)
      aims.push_back(aim_now(i, motor));
    saved.push_back({ids_[i], steps_[i], worlds_[i].from, std::move(aims), numbers_of(worlds_[i].loads),
                     worlds_[i].efforts, state_of(i)});
  }
  return write_worlds(saved_from(), saved);
}

void WorldSet::require_fit(std::size_t index, const SavedWorld& saved, const World& world) const {
  const std::string name = "saved world " + std::to_string(saved.id);
  core::require_input(saved.step >= 0 && std::ssize(saved.aims) == layout_.num_motors(),
                      name + " has not the steps or motors of this scene; the worlds are damaged");
  const auto fits = [](const std::vector<double>& values, std::size_t length) {
    return values.empty() || values.size() == length;
  };
  core::require_input(fits(saved.loads, 6 * static_cast<std::size_t>(layout_.num_bodies())) &&
                          fits(saved.efforts, layout_.joint_axes().size()),
                      name + " has not the bodies or joints of this scene; the worlds are damaged");
  core::require_input(saved.id == ids_[index], name + " is in the place of this rank's world " +
                                                   std::to_string(ids_[index]) +
                                                   "; load on as many ranks, of as many worlds, as saved");
  mpi::require_fit(saved.id, saved.state, *world.model);
  require_islands(saved.id, saved.state);
}

void WorldSet::load(std::span<const std::byte> bytes) {
  const std::vector<SavedWorld> saved = read_worlds(bytes, saved_from());
  core::require_input(saved.size() == num_worlds(),
                      "there are " + std::to_string(saved.size()) + " saved worlds, and this rank has " +
                          std::to_string(num_worlds()) +
                          "; load on as many ranks, of as many worlds, as saved");
  SeededSteppers steppers = make_steppers();
  std::vector<World> worlds;
  for (std::size_t i = 0; i < saved.size(); ++i) {
    const bool is_built = saved[i].from == worlds_[i].from;
    worlds.push_back(is_built ? World{worlds_[i].from, worlds_[i].model, no_aims()}
                              : build(ids_[i], saved[i].from));
    require_fit(i, saved[i], worlds.back());
    steppers.add(ids_[i], solver_seed(worlds.back().from), worlds.back().model, saved[i].state,
                 saved[i].step);
  }
  // From here on nothing throws unless memory runs out.
  steppers_ = std::move(steppers);
  worlds_ = std::move(worlds);
  make_old();
  for (std::size_t i = 0; i < saved.size(); ++i) {
    steps_[i] = saved[i].step;
    bool has_aims = false;
    for (std::size_t motor = 0; motor < saved[i].aims.size(); ++motor) {
      if (std::isnan(saved[i].aims[motor])) continue;
      aim(i, motor, saved[i].aims[motor]);
      has_aims = true;
    }
    worlds_[i].loads = loads_of(saved[i].loads);
    worlds_[i].efforts = saved[i].efforts;
    const bool has_loads = !saved[i].loads.empty() || !saved[i].efforts.empty();
    if (has_loads) push(i);
    // Aiming a motor, or a load, wakes the bodies that it drives, which may have slept with it.
    if (has_aims || has_loads) steppers_.of(ids_[i]).set_state(ids_[i], saved[i].state, saved[i].step);
  }
}

std::uint64_t WorldSet::hash(int world) const {
  const auto at = std::lower_bound(ids_.begin(), ids_.end(), world);
  core::require_input(at != ids_.end() && *at == world, "world " + std::to_string(world) +
                                                            " is not one of this rank's; ask for one of "
                                                            "world_ids()");
  return model::hash(state_of(static_cast<std::size_t>(at - ids_.begin())));
}

std::uint64_t WorldSet::hash() const {
  std::vector<std::uint64_t> hashes(static_cast<std::size_t>(recipe_.num_worlds()), 0);
  for (const int id : ids_) hashes[static_cast<std::size_t>(id)] = hash(id);
  comm_.allreduce(hashes, mpi::Reduce::max);  // ranks that do not own a world have 0 for its hash
  return mpi::combine_world_hashes(hashes);
}

}  // namespace pbmpi::api
