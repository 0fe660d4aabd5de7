// Worlds of one stepper that are at different steps.
#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <string>
#include <utility>

#include "solver/sor_run.h"
#include "stepping/step_options.h"
#include "support/models.h"

namespace pbmpi::solver {
namespace {

using model::Model;
using model::State;
using stepping::StepperSettings;

/// A crash whose first driven axis gets other motors at two steps, so that the joints depend on the step.
Model driven_crash(int variant) {
  Model model = support::crash(variant);
  int joint = 0;
  while (!model.joints[joint].motors[0].active()) ++joint;
  for (const auto& [step, velocity] : {std::pair{6, 8.0}, {15, -8.0}}) {
    model::Event event;
    event.step = step;
    event.kind = model::EventKind::motor;
    event.joint = joint;
    event.motor = {velocity, 50};
    model.events.push_back(event);
  }
  return model;
}

/// The hash of a crash after so many steps by itself.
std::uint64_t alone(const StepperSettings& settings, int variant, int num_steps) {
  const auto stepper = make_stepper(settings, {driven_crash(variant)});
  advance(*stepper, num_steps);
  return model::hash(stepper->state(0));
}

struct Setting {
  std::string name;
  StepperSettings settings;
};
std::ostream& operator<<(std::ostream& out, const Setting& setting) { return out << setting.name; }

std::vector<Setting> every_setting() {
  const StepperSettings by_default = default_settings(stepping::StepperKind::sor);
  const StepperSettings ode_law = default_settings(stepping::StepperKind::sor, stepping::Law::ode);
  const StepperSettings coulomb = default_settings(stepping::StepperKind::sor, stepping::Law::coulomb);
  StepperSettings single = by_default, fixed = by_default;
  single.precision = stepping::Precision::single;
  fixed.law.row_order = stepping::RowOrder::fixed;
  return {{"default", by_default},
          {"single", single},
          {"fixed_order", fixed},
          {"ode_law", ode_law},
          {"coulomb", coulomb}};
}

/// A stepper of crashes, and how many steps each has taken since its start.
class Crashes {
 public:
  explicit Crashes(const StepperSettings& settings) : settings_(settings), stepper_(make_stepper(settings)) {}

  void add(int world) {
    const Model model = driven_crash(world);
    stepper_->add(world, std::make_shared<const Model>(model), initial_state(model), 0);
    steps_[world] = 0;
  }
  void remove(int world) {
    stepper_->remove(world);
    steps_.erase(world);
  }
  void reset(int world) {
    stepper_->set_state(world, initial_state(driven_crash(world)), 0);
    steps_[world] = 0;
  }
  void step(int num_steps) {
    advance(*stepper_, num_steps);
    for (auto& [world, steps] : steps_) steps += num_steps;
  }
  void expect_as_alone() const {
    for (const auto& [world, steps] : steps_)
      EXPECT_EQ(model::hash(stepper_->state(world)), alone(settings_, world, steps)) << "world " << world;
  }

 private:
  StepperSettings settings_;
  std::unique_ptr<stepping::WorldStepper> stepper_;
  std::map<int, int> steps_;
};

class Steps : public testing::TestWithParam<Setting> {};
INSTANTIATE_TEST_SUITE_P(Sor, Steps, testing::ValuesIn(every_setting()),
                         [](const auto& test) { return test.param.name; });

TEST_P(Steps, worlds_that_come_late_have_the_bits_that_each_has_alone) {
  Crashes crashes(GetParam().settings);
  crashes.add(0);
  crashes.add(1);
  crashes.step(4);
  crashes.add(2);
  crashes.step(5);
  crashes.remove(1);
  crashes.add(3);
  crashes.add(4);
  crashes.step(14);
  crashes.expect_as_alone();
}

TEST_P(Steps, worlds_that_are_reset_have_the_bits_that_each_has_alone) {
  Crashes crashes(GetParam().settings);
  for (int world = 0; world < 21; ++world) crashes.add(world);
  crashes.step(17);  // past the motors' events
  for (const int world : {3, 4, 17}) crashes.reset(world);
  crashes.step(3);
  crashes.reset(5);
  crashes.step(10);
  crashes.expect_as_alone();
}

TEST_P(Steps, all_worlds_can_be_reset_in_their_packs) {
  Crashes crashes(GetParam().settings);
  for (int world = 0; world < 5; ++world) crashes.add(world);
  crashes.step(17);
  for (int world = 0; world < 5; ++world) crashes.reset(world);
  crashes.step(12);
  crashes.expect_as_alone();
}

}  // namespace
}  // namespace pbmpi::solver
