#include "solver/worlds/sor_stepper.h"

#include <functional>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/system/thread_pool.h"
#include "solver/pack/step_settings.h"
#include "solver/worlds/sor_world.h"
#include "solver/worlds/world_groups.h"

namespace pbmpi::solver {
namespace {

class SorStepper final : public stepping::AnytimeStepper {
 public:
  SorStepper(const stepping::StepperSettings& settings, model::MakeNarrowPhase make_narrow_phase)
      : settings_(settings), make_narrow_phase_(std::move(make_narrow_phase)), groups_(settings_) {}

  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) override {
    drop_begun();
    const auto added = worlds_.emplace(world, std::make_unique<SorWorld>(world, std::move(model), state, step,
                                                                         settings_, make_narrow_phase_));
    core::require_invariant(added.second, "a world was added twice");
    groups_.add(*added.first->second);
  }
  void remove(int world) override {
    drop_begun();
    const auto found = worlds_.find(world);
    core::require_invariant(found != worlds_.end(), "a world was removed that is not there");
    groups_.remove(*found->second);
    worlds_.erase(found);
  }
  void set_state(int world, const model::State& state, std::int64_t step) override;
  void set_motor_velocity(int world, int joint, int axis, double velocity) override;
  const model::State& state(int world) const override { return worlds_.at(world)->state(); }
  const model::Model& model(int world) const override { return worlds_.at(world)->model(); }
  const stepping::Observables& observables(int world) const override {
    return worlds_.at(world)->observables();
  }
  double cost_s(int world) const override { return worlds_.at(world)->cost_s; }
  const stepping::StepContacts* contacts(int world) const override { return worlds_.at(world)->contacts(); }

  void advance(int num_steps, core::PhaseTimes& times) override;
  void begin_step(int iterations, core::PhaseTimes& times) override;
  const model::State& look(int world) const override {
    const auto place = groups_.place(*worlds_.at(world));
    return place.group->look(place.index);
  }

 private:
  /// Puts the worlds back to before the step that has begun.
  void drop_begun() {
    if (std::exchange(begun_, false)) groups_.dissolve();
  }
  using Step = std::function<void(WorldGroup& group, core::PhaseTimes& spent)>;
  void step_groups(core::PhaseTimes& times, const Step& step);
  void step_by_threads(core::PhaseTimes& times, const Step& step);

  stepping::StepperSettings settings_;
  model::MakeNarrowPhase make_narrow_phase_;
  std::map<int, std::unique_ptr<SorWorld>> worlds_;
  WorldGroups groups_;
  bool begun_ = false;                       ///< is every group in mid-step?
  std::optional<core::ThreadPool> threads_;  ///< none until there is work for several threads
};

void SorStepper::set_state(int world, const model::State& state, std::int64_t step) {
  drop_begun();
  SorWorld& changed = *worlds_.at(world);
  if (changed.mends(state)) groups_.dissolve_group_of(changed);  // a pack cannot mend joints
  const bool same_step = changed.step() == step;
  changed.set_state(state, step);
  const auto place = groups_.place(changed);
  if (place.group == nullptr) return;
  if (same_step) {
    changed.load(place.group->pack(), place.index);
  } else {
    changed.enter(place.group->pack(), place.index);
    groups_.note_step();
  }
}

void SorStepper::set_motor_velocity(int world, int joint, int axis, double velocity) {
  SorWorld& aimed = *worlds_.at(world);
  const auto place = groups_.place(aimed);
  Pack* pack = place.group == nullptr ? nullptr : &place.group->pack();
  if (aimed.aim(joint, axis, velocity, pack, place.index)) drop_begun();
}

/// Each group takes all steps before the next group starts, so that its data stays in the cache.
void SorStepper::advance(int num_steps, core::PhaseTimes& times) {
  step_groups(times, [&](WorldGroup& group, core::PhaseTimes& spent) { group.advance(num_steps, spent); });
  for (const auto& group : groups_.all()) group->share_cost();
  begun_ = begun_ && num_steps == 0;
}

/// All groups stop before any continues, so that the estimates of all worlds are available at once.
void SorStepper::begin_step(int iterations, core::PhaseTimes& times) {
  core::require_invariant(!begun_, "begin_step: the step before is finished");
  core::require_invariant(iterations >= 0 && iterations <= settings_.iterations,
                          "begin_step: no more iterations than a step has");
  step_groups(times,
              [&](WorldGroup& group, core::PhaseTimes& spent) { group.begin_step(iterations, spent); });
  begun_ = true;
}

void SorStepper::step_groups(core::PhaseTimes& times, const Step& step) {
  groups_.complete();
  if (settings_.threads > 1 && groups_.all().size() > 1) return step_by_threads(times, step);
  for (const auto& group : groups_.all()) {
    step(*group, times);
    group->note_cost(1);
  }
}

/// Time that threads spend in parallel counts once: the seconds of phases and worlds are scaled so that their
/// sums are wall-clock time, as with one thread. This makes the loads of ranks with different numbers of
/// threads comparable.
void SorStepper::step_by_threads(core::PhaseTimes& times, const Step& step) {
  if (!threads_) threads_.emplace(settings_.threads);
  std::vector<core::PhaseTimes> spent(static_cast<std::size_t>(threads_->num_threads()));
  const auto groups = groups_.all();
  const double start_s = core::now_s();
  threads_->run(static_cast<int>(groups.size()), [&](int group, int thread) {
    step(*groups[static_cast<std::size_t>(group)], spent[static_cast<std::size_t>(thread)]);
  });
  const double passed_s = core::now_s() - start_s;
  double sum_s = 0;
  for (const auto& group : groups) sum_s += group->spent_s();
  const double share = sum_s > 0 ? passed_s / sum_s : 1;
  for (const auto& group : groups) group->note_cost(share);
  for (const core::PhaseTimes& of_thread : spent) {
    for (std::size_t phase = 0; phase < times.seconds.size(); ++phase)
      times.seconds[phase] += share * of_thread.seconds[phase];
  }
}

}  // namespace

std::unique_ptr<stepping::AnytimeStepper> make_sor_stepper(const stepping::StepperSettings& settings,
                                                           model::MakeNarrowPhase make_narrow_phase) {
  require_valid(settings);
  return std::make_unique<SorStepper>(settings, std::move(make_narrow_phase));
}

}  // namespace pbmpi::solver
