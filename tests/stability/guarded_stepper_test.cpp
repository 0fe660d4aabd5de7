#include "stability/guarded_stepper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>

#include "guarded_run.h"
#include "stepping/stepper_traits.h"
#include "support/hard_models.h"
#include "support/models.h"

namespace pbmpi::stability {
namespace {

namespace event_kind = stepping::event_kind;
using model::Model;
using stepping::RunEvent;
using stepping::StepperKind;
using stepping::StepperSettings;

StepperSettings of_kind(StepperKind kind) { return default_settings(kind, stepping::Law::ode); }

StepperSettings few_iterations() {
  StepperSettings settings = of_kind(StepperKind::sor);
  settings.substeps = 5;
  settings.iterations = 3;
  return settings;
}

std::vector<RunEvent> of_kind(const std::vector<RunEvent>& events, const char* kind) {
  std::vector<RunEvent> found;
  std::ranges::copy_if(events, std::back_inserter(found), [&](const RunEvent& e) { return e.kind == kind; });
  return found;
}

std::vector<RunEvent> events_of(const Model& model, const StepperSettings& settings, int num_frames,
                                OnBlowup on_blowup = OnBlowup::report) {
  return run_frames(*make_guarded({model}, settings, on_blowup), num_frames);
}

class BothSteppers : public testing::TestWithParam<StepperKind> {};
INSTANTIATE_TEST_SUITE_P(QuickAndSor, BothSteppers, testing::Values(StepperKind::quick, StepperKind::sor));

TEST_P(BothSteppers, a_loaded_chain_gapes) {
  const auto events =
      of_kind(events_of(support::loaded_chain(20, 100), of_kind(GetParam()), 40), event_kind::joint_gap);
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events[0].world, 0);
  EXPECT_GE(events[0].joint, 0);
  EXPECT_FALSE(events[0].name.empty());
  EXPECT_GT(events[0].value, 0.2);
  EXPECT_EQ(events[0].detail, "world 0: the joint '" + events[0].name + "' gapes by " +
                                  events[0].detail.substr(events[0].detail.find("by ") + 3));
}

TEST_P(BothSteppers, balls_that_fall_through_a_plate_are_noticed_in_their_step) {
  model::Model model = support::balls_over_plate(120);
  model.effects["fast_bodies"] = false;
  const auto events = of_kind(events_of(model, of_kind(GetParam()), 200), event_kind::passage);
  ASSERT_FALSE(events.empty());
  EXPECT_TRUE(events[0].name.starts_with("ball"));
  EXPECT_NE(events[0].detail.find("went through 'plate'"), std::string::npos) << events[0].detail;
  // A ball that falls 119 m takes 4.93 s.
  EXPECT_NEAR(static_cast<double>(events[0].step), 493, 4);
}

TEST_P(BothSteppers, cubes_thrown_apart_gain_energy) {
  EXPECT_FALSE(
      of_kind(events_of(support::overlapping_cubes(), of_kind(GetParam()), 5), event_kind::energy_gain)
          .empty());
}

TEST_P(BothSteppers, nothing_is_noticed_where_nothing_happens) {
  EXPECT_TRUE(events_of(support::box_over_ground(1), of_kind(GetParam()), 100).empty());
  EXPECT_TRUE(events_of(support::chain(5), of_kind(GetParam()), 100).empty());
  EXPECT_TRUE(events_of(support::falling_balls(3, 0.5), of_kind(GetParam()), 100).empty());
}

TEST(GuardedStepper, notices_that_few_iterations_feed_elastic_balls) {
  EXPECT_FALSE(
      of_kind(events_of(support::elastic_balls(40), few_iterations(), 200), event_kind::energy_gain).empty());
}

TEST(GuardedStepper, notices_a_motor_that_pulls_its_joint_apart) {
  EXPECT_FALSE(
      of_kind(events_of(support::motor_at_limit(1e6), few_iterations(), 50), event_kind::joint_gap).empty());
}

/// Turns a world's state to NaN in one step; steps with sor otherwise.
class Breaking final : public stepping::WorldStepper {
 public:
  Breaking(const StepperSettings& settings, int world, std::int64_t step)
      : inner_(make_any_stepper(settings)), world_(world), bad_step_(step) {}

  void add(int world, std::shared_ptr<const Model> model, const model::State& state,
           std::int64_t step) override {
    inner_->add(world, std::move(model), state, step);
    step_[world] = step;
  }
  void remove(int world) override {
    inner_->remove(world);
    step_.erase(world);
  }
  void set_state(int world, const model::State& state, std::int64_t step) override {
    inner_->set_state(world, state, step);
    step_[world] = step;
  }
  void set_motor_velocity(int world, int joint, int axis, double velocity) override {
    inner_->set_motor_velocity(world, joint, axis, velocity);
  }
  void advance(int num_steps, core::PhaseTimes& times) override {
    for (int i = 0; i < num_steps; ++i) {
      inner_->advance(1, times);
      for (auto& [world, step] : step_) {
        if (step++ == bad_step_ && world == world_) spoil();
      }
    }
  }
  const model::State& state(int world) const override { return inner_->state(world); }
  const Model& model(int world) const override { return inner_->model(world); }
  const stepping::Observables& observables(int world) const override {
    seen_ = inner_->observables(world);
    observe_state(model(world), state(world), seen_);
    return seen_;
  }
  double cost_s(int world) const override { return inner_->cost_s(world); }

 private:
  void spoil() {
    model::State state = inner_->state(world_);
    state.velocity.back().x() = std::numeric_limits<double>::quiet_NaN();
    inner_->set_state(world_, state, bad_step_ + 1);
  }

  std::unique_ptr<stepping::WorldStepper> inner_;
  int world_;
  std::int64_t bad_step_;
  std::map<int, std::int64_t> step_;
  mutable stepping::Observables seen_;
};

std::unique_ptr<GuardedStepper> make_breaking(OnBlowup on_blowup, int world, std::int64_t step) {
  const MakeStepper make = [=](const StepperSettings& settings) {
    // Only steps of the run's own length are spoiled.
    return std::make_unique<Breaking>(settings, world, settings.dt_s == StepperSettings{}.dt_s ? step : -1);
  };
  const StepperSettings settings = of_kind(StepperKind::sor);
  auto stepper =
      std::make_unique<GuardedStepper>(make(settings), GuardSettings{on_blowup, settings, make, {}});
  for (int i = 0; i < 3; ++i) {
    const auto model = std::make_shared<const Model>(support::crash(i));
    stepper->add(i, model, initial_state(*model), 0);
  }
  return stepper;
}

TEST(GuardedStepper, names_body_and_step_where_a_number_is_not_finite) {
  const auto stepper = make_breaking(OnBlowup::report, 1, 7);
  const auto events = run_frames(*stepper, 3);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, event_kind::nonfinite);
  EXPECT_EQ(events[0].world, 1);
  EXPECT_EQ(events[0].step, 7);
  EXPECT_FALSE(events[0].name.empty());
  EXPECT_GT(stepper->observables(1).nonfinite, 0);
}

TEST(GuardedStepper, names_an_observable_that_is_not_finite_once) {
  Model heavy = support::free_box();
  heavy.bodies[0].mass_kg = 1e300;
  heavy.bodies[0].velocity.x() = 1e10;
  const StepperSettings settings = of_kind(StepperKind::sor);
  const MakeStepper make = [](const StepperSettings& chosen) { return make_any_stepper(chosen); };
  GuardedStepper stepper(make(settings), GuardSettings{OnBlowup::report, settings, make, {}});
  const auto model = std::make_shared<const Model>(std::move(heavy));
  stepper.add(0, model, initial_state(*model), 0);
  const auto events = run_frames(stepper, 3);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, event_kind::nonfinite);
  EXPECT_EQ(events[0].name, "energy");
  EXPECT_EQ(events[0].detail,
            "world 0: the observable 'energy' is not finite, though all bodies are, in step 0");
  EXPECT_EQ(stepper.observables(0).nonfinite, 0);
}

std::vector<std::uint64_t> hashes_of(const stepping::WorldStepper& stepper) {
  std::vector<std::uint64_t> hashes;
  for (int world = 0; world < 3; ++world) hashes.push_back(model::hash(stepper.state(world)));
  return hashes;
}

std::vector<std::uint64_t> unwatched_hashes(int num_steps) {
  const auto stepper = make_any_stepper(of_kind(StepperKind::sor));
  for (int i = 0; i < 3; ++i) {
    const auto model = std::make_shared<const Model>(support::crash(i));
    stepper->add(i, model, initial_state(*model), 0);
  }
  core::PhaseTimes times;
  stepper->advance(num_steps, times);
  return hashes_of(*stepper);
}

TEST(GuardedStepper, freezes_a_world_before_its_bad_step_and_leaves_the_others_their_bits) {
  const auto stepper = make_breaking(OnBlowup::freeze, 1, 7);
  const auto events = run_frames(*stepper, 4);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[1].kind, event_kind::frozen);
  EXPECT_EQ(events[1].step, 7);
  EXPECT_EQ(stepper->state(1).guard.frozen_in, 7);
  EXPECT_EQ(stepper->observables(1).nonfinite, 0);
  const auto found = hashes_of(*stepper), free = unwatched_hashes(12);
  EXPECT_EQ(found[0], free[0]);
  EXPECT_EQ(found[2], free[2]);
  model::State stands = stepper->state(1);
  EXPECT_NE(model::hash(stands), unwatched_hashes(7)[1]) << "the hash tells a world that stands";
  stands.guard = {};
  EXPECT_EQ(model::hash(stands), unwatched_hashes(7)[1]) << "it stands at the state before the step";
}

TEST(GuardedStepper, refines_a_bad_step_and_goes_on) {
  const auto stepper = make_breaking(OnBlowup::refine, 1, 7);
  const auto events = run_frames(*stepper, 4);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[1].kind, event_kind::refined);
  EXPECT_EQ(events[1].step, 7);
  EXPECT_EQ(events[1].value, 2);
  EXPECT_EQ(stepper->state(1).guard.frozen_in, -1);
  EXPECT_EQ(stepper->observables(1).nonfinite, 0);
  const auto found = hashes_of(*stepper), free = unwatched_hashes(12);
  EXPECT_EQ(found[0], free[0]);
  EXPECT_NE(found[1], free[1]) << "one of its steps was done as two";
  EXPECT_EQ(found[2], free[2]);
}

/// The first joint of a crash that has a motor, and its target velocity.
constexpr double aimed_velocity = 6;
int driven_joint() {
  const Model model = support::crash();
  int joint = 0;
  while (!model.joints[joint].motors[0].active()) ++joint;
  return joint;
}

/// World 1 of the crashes, `num_steps` after `state` at `step`, with the target of its motor set.
model::State aimed_crash(const StepperSettings& settings, const model::State& state, std::int64_t step,
                         int num_steps) {
  const auto stepper = make_any_stepper(settings);
  stepper->add(1, std::make_shared<const Model>(support::crash(1)), state, step);
  stepper->set_motor_velocity(1, driven_joint(), 0, aimed_velocity);
  core::PhaseTimes times;
  stepper->advance(num_steps, times);
  return stepper->state(1);
}

TEST(GuardedStepper, steps_a_world_again_with_the_targets_of_its_motors) {
  const StepperSettings settings = of_kind(StepperKind::sor);
  StepperSettings shorter = settings;
  shorter.dt_s /= 2;
  const model::State start = initial_state(support::crash(1));
  const model::State before = aimed_crash(settings, start, 0, 7);
  ASSERT_NE(model::hash(before), unwatched_hashes(7)[1]);
  for (const OnBlowup on_blowup : {OnBlowup::freeze, OnBlowup::refine}) {
    const auto stepper = make_breaking(on_blowup, 1, 7);
    stepper->set_motor_velocity(1, driven_joint(), 0, aimed_velocity);
    run_frames(*stepper, 4);
    model::State found = stepper->state(1);
    found.guard = {};
    const model::State after = aimed_crash(shorter, before, 14, 2);
    EXPECT_EQ(model::hash(found),
              model::hash(on_blowup == OnBlowup::freeze ? before : aimed_crash(settings, after, 8, 4)));
    stepper->set_state(1, start, 12);
    run_frames(*stepper, 2);
    EXPECT_EQ(model::hash(stepper->state(1)), model::hash(aimed_crash(settings, start, 12, 6)))
        << "the target is still there";
  }
}

TEST(GuardedStepper, forgets_a_target_with_the_event_that_ends_it) {
  Model model = support::crash();
  model::Event event;
  event.step = 4;
  event.kind = model::EventKind::motor;
  event.joint = driven_joint();
  event.motor = {-2, 20};
  model.events.push_back(event);
  const StepperSettings settings = of_kind(StepperKind::sor);
  const auto guarded = make_guarded({model}, settings, OnBlowup::report);
  const auto other = make_any_stepper(settings);
  other->add(0, std::make_shared<const Model>(model), initial_state(model), 0);
  for (stepping::WorldStepper* stepper : {static_cast<stepping::WorldStepper*>(guarded.get()), other.get()}) {
    stepper->set_motor_velocity(0, event.joint, 0, aimed_velocity);
    core::PhaseTimes times;
    stepper->advance(6, times);
    const model::State state = stepper->state(0);
    stepper->set_state(0, state, 2);  // before the event
    stepper->advance(2, times);
  }
  EXPECT_EQ(model::hash(guarded->state(0)), model::hash(other->state(0)));
}

TEST(GuardedStepper, refines_the_chain_that_gapes_or_freezes_it) {
  const auto stepper =
      make_guarded({support::loaded_chain(20, 100)}, of_kind(StepperKind::quick), OnBlowup::refine);
  const auto events = run_frames(*stepper, 40);
  EXPECT_EQ(of_kind(events, event_kind::joint_gap).size() + of_kind(events, event_kind::energy_gain).size() +
                of_kind(events, event_kind::passage).size(),
            of_kind(events, event_kind::refined).size() + of_kind(events, event_kind::frozen).size());
  EXPECT_LE(of_kind(events, event_kind::frozen).size(), 1u);
}

/// Moves each world to another stepper in mid-run, with only its State.
TEST(GuardedStepper, goes_on_alike_in_another_stepper) {
  const std::vector<Model> worlds = {support::overlapping_cubes(), support::pile(4),
                                     support::loaded_chain(20, 100), support::crash()};
  for (const OnBlowup on_blowup : {OnBlowup::report, OnBlowup::freeze, OnBlowup::refine}) {
    for (const StepperKind kind : {StepperKind::quick, StepperKind::sor}) {
      const auto whole = make_guarded(worlds, of_kind(kind), on_blowup);
      const auto first = make_guarded(worlds, of_kind(kind), on_blowup);
      const auto second = make_guarded({}, of_kind(kind), on_blowup);
      const auto events_of_whole = run_frames(*whole, 30);
      auto events = run_frames(*first, 11);
      for (std::size_t i = 0; i < worlds.size(); ++i) {
        const int world = static_cast<int>(i);
        second->add(world, std::make_shared<const Model>(worlds[i]), first->state(world), 33);
      }
      for (RunEvent& event : run_frames(*second, 19)) events.push_back(event);
      ASSERT_EQ(events.size(), events_of_whole.size());
      for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(events[i].detail, events_of_whole[i].detail);
      for (int world = 0; world < 4; ++world) {
        const model::State &a = whole->state(world), &b = second->state(world);
        EXPECT_EQ(model::hash(a), model::hash(b));
        EXPECT_EQ(a.guard.energy_gain_j, b.guard.energy_gain_j);
        EXPECT_EQ(a.guard.largest_kinetic_j, b.guard.largest_kinetic_j);
        EXPECT_EQ(whole->observables(world).energy_j, second->observables(world).energy_j);
      }
    }
  }
}

TEST(GuardedStepper, a_world_that_stands_goes_on_in_another_state) {
  const auto stepper = make_breaking(OnBlowup::freeze, 0, 1);
  run_frames(*stepper, 2);
  ASSERT_EQ(stepper->state(0).guard.frozen_in, 1);
  stepper->set_state(0, initial_state(stepper->model(0)), 6);
  run_frames(*stepper, 1);
  EXPECT_NE(stepper->state(0).position[0], stepper->model(0).bodies[0].pose.position);
}

TEST(GuardedStepper, changes_no_bit_of_a_world_in_which_no_guard_trips) {
  const auto stepper = make_breaking(OnBlowup::refine, 1, -1);
  EXPECT_TRUE(run_frames(*stepper, 4).empty());
  EXPECT_EQ(hashes_of(*stepper), unwatched_hashes(12));
}

}  // namespace
}  // namespace pbmpi::stability
