#include "solver/worlds/sor_stepper.h"

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

class SorStepper final : public stepping::WorldStepper {
 public:
  SorStepper(const stepping::StepperSettings& settings, model::MakeNarrowPhase make_narrow_phase)
      : settings_(settings), make_narrow_phase_(std::move(make_narrow_phase)), groups_(settings_) {}

  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) override {
    const auto added = worlds_.emplace(world, std::make_unique<SorWorld>(world, std::move(model), state, step,
                                                                         settings_, make_narrow_phase_));
    core::require_invariant(added.second, "a world was added twice");
    groups_.add(*added.first->second);
  }
  void remove(int world) override {
    const auto found = worlds_.find(world);
    core::require_invariant(found != worlds_.end(), "a world was removed that is not there");
    groups_.remove(*found->second);
    worlds_.erase(found);
  }
  void set_state(int world, const model::State& state, std::int64_t step) override;
  void set_motor_velocity(int world, int joint, int axis, double velocity) override;
  void set_load(int world, int body, const stepping::BodyLoad& load) override;
  const model::State& state(int world) const override { return worlds_.at(world)->state(); }
  const model::Model& model(int world) const override { return worlds_.at(world)->model(); }
  const stepping::Observables& observables(int world) const override {
    return worlds_.at(world)->observables();
  }
  double cost_s(int world) const override { return worlds_.at(world)->cost_s; }
  const stepping::StepContacts* contacts(int world) const override { return worlds_.at(world)->contacts(); }

  void advance(int num_steps, core::PhaseTimes& times) override;

 private:
  void advance_by_threads(int num_steps, core::PhaseTimes& times);

  stepping::StepperSettings settings_;
  model::MakeNarrowPhase make_narrow_phase_;
  std::map<int, std::unique_ptr<SorWorld>> worlds_;
  WorldGroups groups_;
  std::optional<core::ThreadPool> threads_;  ///< none until there is work for several threads
};

void SorStepper::set_state(int world, const model::State& state, std::int64_t step) {
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
  aimed.aim(joint, axis, velocity, pack, place.index);
}

void SorStepper::set_load(int world, int body, const stepping::BodyLoad& load) {
  SorWorld& pushed = *worlds_.at(world);
  const auto place = groups_.place(pushed);
  Pack* pack = place.group == nullptr ? nullptr : &place.group->pack();
  pushed.push(body, load, pack, place.index);
}

/// Each group takes all steps before the next group starts, so that its data stays in the cache.
void SorStepper::advance(int num_steps, core::PhaseTimes& times) {
  groups_.complete();
  if (settings_.threads > 1 && groups_.all().size() > 1) return advance_by_threads(num_steps, times);
  for (const auto& group : groups_.all()) {
    group->advance(num_steps, times);
    group->share_cost(1);
  }
}

/// Time that threads spend in parallel counts once: the seconds of phases and worlds are scaled so that their
/// sums are wall-clock time, as with one thread. This makes the loads of ranks with different numbers of
/// threads comparable.
void SorStepper::advance_by_threads(int num_steps, core::PhaseTimes& times) {
  if (!threads_) threads_.emplace(settings_.threads);
  std::vector<core::PhaseTimes> spent(static_cast<std::size_t>(threads_->num_threads()));
  const auto groups = groups_.all();
  const double start_s = core::now_s();
  threads_->run(static_cast<int>(groups.size()), [&](int group, int thread) {
    groups[static_cast<std::size_t>(group)]->advance(num_steps, spent[static_cast<std::size_t>(thread)]);
  });
  const double passed_s = core::now_s() - start_s;
  double sum_s = 0;
  for (const auto& group : groups) sum_s += group->spent_s();
  const double share = sum_s > 0 ? passed_s / sum_s : 1;
  for (const auto& group : groups) group->share_cost(share);
  for (const core::PhaseTimes& of_thread : spent) {
    for (std::size_t phase = 0; phase < times.seconds.size(); ++phase)
      times.seconds[phase] += share * of_thread.seconds[phase];
  }
}

}  // namespace

std::unique_ptr<stepping::WorldStepper> make_sor_stepper(const stepping::StepperSettings& settings,
                                                         model::MakeNarrowPhase make_narrow_phase) {
  require_valid(settings);
  return std::make_unique<SorStepper>(settings, std::move(make_narrow_phase));
}

}  // namespace pbmpi::solver
