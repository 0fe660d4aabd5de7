// The memory that a step hands on to the next (State::memory), in a world cut into spaces.
#include <gtest/gtest.h>

#include <atomic>

#include "model/state_parts.h"
#include "solver/spaces/unit_memory.h"
#include "space_run.h"
#include "stepping/step_options.h"
#include "wrapped_space_stepper.h"

namespace pbmpi::mpi {
namespace {

using testing_support::make_space_stepper;
using testing_support::neighbours;
using testing_support::placements_of_four_spaces;
using testing_support::share;
using testing_support::SharedModel;
using testing_support::space_settings;
using testing_support::world;

/// Moves bodies as sor without a warm start does, and keeps an account of contacts and joints in the memory
/// that depends on all previous steps, so that anything lost in transit shows at the end.
class Accountant final : public testing_support::WrappedSpaceStepper {
 public:
  explicit Accountant(const SharedModel& model)
      : WrappedSpaceStepper(make_space_stepper(model)), articulations_(solver::find_articulations(*model)) {}

  const model::State& state() const override {
    state_ = inner().state();
    state_.memory = memory_;
    return state_;
  }
  void own(std::span<const int> spaces, const model::State& state, std::int64_t step) override {
    const model::StepMemory memory = state.memory;  // `state` may be the result of state()
    WrappedSpaceStepper::own(spaces, state, step);
    memory_ = memory;
  }
  bool remembers() const override { return true; }
  std::vector<double> memory_rows(std::span<const int> units) const override {
    return unit_memory().rows(units, memory_);
  }
  void put_memory(std::span<const int> units, std::span<const double> rows) override {
    unit_memory().put(units, rows, model().joints.size(), memory_);
  }
  void solve(std::span<const int> units, std::span<const model::Contact> contacts, std::int64_t step,
             core::PhaseTimes& times) override {
    WrappedSpaceStepper::solve(units, contacts, step, times);
    book(units, contacts);
  }

 private:
  solver::UnitMemory unit_memory() const { return {map(), articulations_}; }
  void book(std::span<const int> units, std::span<const model::Contact> contacts);
  model::ContactForce entry_of(const model::Contact& contact, std::size_t place) const;

  std::vector<solver::Articulation> articulations_;
  model::StepMemory memory_;
  mutable model::State state_;
};

/// Starts from the previous entry for the same point: the one at this place among the points of the pair.
model::ContactForce Accountant::entry_of(const model::Contact& contact, std::size_t place) const {
  model::ContactForce entry{contact.geoms, contact.body_a, contact.body_b, contact.position};
  for (const model::ContactForce& before : memory_.contacts) {
    if (before.geoms == entry.geoms && place-- == 0) entry.normal = before.normal;
  }
  entry.normal = 0.9 * entry.normal + contact.depth;
  entry.friction = entry.normal * contact.normal;
  return entry;
}

void Accountant::book(std::span<const int> units, std::span<const model::Contact> contacts) {
  model::StepMemory booked;
  std::size_t place = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    place = i > 0 && contacts[i - 1].geoms == contacts[i].geoms ? place + 1 : 0;
    booked.contacts.push_back(entry_of(contacts[i], place));
  }
  booked.joints = memory_.joints;
  booked.joints.resize(model().joints.size());
  for (const int unit : units) {
    for (const int joint : articulations_[unit].joints) {
      model::JointForce& force = booked.joints[joint];
      force.torque = 0.9 * force.torque + inner().state().velocity[model().joints[joint].body_a];
      force.control[1] += 1;
    }
  }
  put_memory(units, unit_memory().rows(units, booked));
}

class Shelf : public SnapshotKeeper {
 public:
  std::string keep(Snapshot snapshot) override {
    snapshots.push_back(std::move(snapshot));
    return "kept";
  }
  std::vector<Snapshot> snapshots;
};

std::uint64_t run(const Communicator& comm, const SharedModel& model, const WorldRunSettings& settings,
                  std::span<const model::State> states = {}, SnapshotKeeper* keeper = nullptr) {
  Accountant stepper(model);
  SpaceDriver driver(comm, stepper, settings, states);
  CheckpointPlan plan;
  plan.at_end = true;
  if (keeper != nullptr) driver.save_to(*keeper, plan);
  return driver.run().state_hash;
}

std::uint64_t undivided(const SharedModel& model, WorldRunSettings settings) {
  settings.placement.clear();
  return run(Communicator(), model, settings);
}

TEST(SpaceMemory, travels_with_the_units_whoever_owns_and_solves_them) {
  const SharedModel model = share(neighbours());
  WorldRunSettings settings = space_settings();
  settings.rebalance_threshold = model::infinity;
  const std::uint64_t expected = undivided(model, settings);
  for (const Placement& placement : placements_of_four_spaces(world().size(), 23)) {
    settings.placement = placement;
    EXPECT_EQ(run(world(), model, settings), expected) << testing::PrintToString(placement);
  }
}

TEST(SpaceMemory, travels_with_the_spaces_that_change_their_owner) {
  const SharedModel model = share(neighbours());
  WorldRunSettings settings = space_settings(40);
  settings.placement = {0, 0, 0, 0};
  settings.rebalance_threshold = 1;
  EXPECT_EQ(run(world(), model, settings), undivided(model, settings));
}

TEST(SpaceMemory, is_there_again_where_a_run_goes_on_from_the_states_of_root) {
  const SharedModel model = share(neighbours());
  const WorldRunSettings whole = space_settings(20);
  WorldRunSettings first = whole, rest = whole;
  first.frames = 9;
  Shelf shelf;
  run(world(), model, first, {}, &shelf);
  std::vector<model::State> states;
  if (world().is_root()) states = shelf.snapshots.at(0).worlds;
  for (const model::State& state : states) EXPECT_FALSE(state.memory.contacts.empty());
  rest.first_frame = first.warmup + first.frames;
  rest.placement = {world().size() - 1, 0, world().size() - 1, 0};
  EXPECT_EQ(run(world(), model, rest, states), undivided(model, whole));
}

TEST(SpaceMemory, of_a_world_that_is_cut_is_that_of_the_whole_one) {
  const SharedModel model = share(neighbours());
  stepping::StepperSettings hard = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  stepping::StepperSettings single = default_settings(stepping::StepperKind::sor);
  hard.law.warm_start = 0.8;
  single.precision = stepping::Precision::single;
  for (const stepping::StepperSettings& stepper :
       {hard, default_settings(stepping::StepperKind::sor), single}) {
    WorldRunSettings settings = space_settings();
    const std::uint64_t expected = testing_support::whole_hash(model, settings, stepper);
    settings.rebalance_threshold = model::infinity;
    for (const Placement& placement : placements_of_four_spaces(world().size(), 37)) {
      settings.placement = placement;
      EXPECT_EQ(testing_support::run_spaces(world(), model, settings, stepper).result.state_hash, expected)
          << setting_text(stepper) << testing::PrintToString(placement);
    }
  }
}

}  // namespace
}  // namespace pbmpi::mpi
