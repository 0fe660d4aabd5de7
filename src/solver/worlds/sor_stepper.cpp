#include "solver/worlds/sor_stepper.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/marks.h"
#include "solver/layout/articulation.h"
#include "solver/pack/step_settings.h"
#include "solver/worlds/sor_world.h"

namespace pbmpi::solver {
namespace {

using core::LapTimer;
using core::Phase;
using core::PhaseMark;

/// Bytes of velocities and rows that a pack may have for each body, about: what a sweep reads again and again
/// should stay in a core's second cache (measured on 100CrSk: 500 to 2,000 bodies in float are alike, twice
/// as many cost a tenth; in double half as many).
constexpr int bytes_a_number(stepping::Precision precision) {
  return precision == stepping::Precision::single ? 4 : 8;
}
constexpr int bodies_times_bytes_a_pack = 7200;

/// Worlds that are stepped together.
struct Group {
  std::vector<SorWorld*> worlds;
  std::unique_ptr<Pack> pack;
  std::vector<std::vector<model::Contact>> contacts;  ///< [worlds] of this step
  std::vector<char> may_be_fast;                      ///< likewise: Pack::find_fast()
  std::vector<FocusedWorld> focused_worlds;           ///< [worlds] for the step at hand
  FocusedStep focused;
  bool sleeps = false;              ///< in the step at hand nothing moves
  std::vector<model::State> looks;  ///< [worlds] of the step that was begun
  double begun_s = 0;               ///< seconds spent on it
};

class SorStepper final : public stepping::AnytimeStepper {
 public:
  SorStepper(const stepping::StepperSettings& settings, model::MakeNarrowPhase make_narrow_phase)
      : settings_(settings), make_narrow_phase_(std::move(make_narrow_phase)) {}

  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) override {
    worlds_.emplace(world, std::make_unique<SorWorld>(world, std::move(model), state, step, settings_,
                                                      make_narrow_phase_));
    drop_groups();
  }
  void remove(int world) override {
    worlds_.erase(world);
    drop_groups();
  }
  void set_state(int world, const model::State& state, std::int64_t step) override;
  const model::State& state(int world) const override { return worlds_.at(world)->state(); }
  const model::Model& model(int world) const override { return worlds_.at(world)->model(); }
  const stepping::Observables& observables(int world) const override {
    return worlds_.at(world)->observables();
  }
  double cost_s(int world) const override { return worlds_.at(world)->cost_s; }
  const stepping::StepContacts* contacts(int world) const override { return worlds_.at(world)->contacts(); }

  void advance(int num_steps, core::PhaseTimes& times) override {
    if (groups_.empty()) make_groups();
    for (Group& group : groups_) {
      const double start_s = core::now_s() - group.begun_s;
      for (int i = 0; i < num_steps; ++i) {
        if (i > 0 || !begun_) begin(group, std::nullopt, times);
        finish(group, times);
      }
      observe(group, times);
      share_cost(group, core::now_s() - start_s);
      group.begun_s = 0;
    }
    begun_ = begun_ && num_steps == 0;
  }

  void begin_step(int iterations, core::PhaseTimes& times) override;
  const model::State& look(int world) const override {
    const auto [group, index] = places_.at(world);
    return groups_[group].looks[static_cast<std::size_t>(index)];
  }

 private:
  /// They are made anew from the states before the next step.
  void drop_groups() {
    groups_.clear();
    begun_ = false;
  }
  void make_groups();
  static void look(Group& group, core::PhaseTimes& times);
  /// Up to the iterations of the last substep; `look_after`: they will be looked at after so many.
  void begin(Group& group, std::optional<int> look_after, core::PhaseTimes& times);
  void collide(Group& group) const;
  void focus(Group& group) const;
  static void finish(Group& group, core::PhaseTimes& times);
  void observe(Group& group, core::PhaseTimes& times) const;
  static void share_cost(Group& group, double seconds);

  stepping::StepperSettings settings_;
  model::MakeNarrowPhase make_narrow_phase_;
  std::map<int, std::unique_ptr<SorWorld>> worlds_;
  std::vector<Group> groups_;                          ///< empty: to be made anew
  std::map<int, std::pair<std::size_t, int>> places_;  ///< world -> its group, and its index there
  bool begun_ = false;                                 ///< is every group in mid-step?
};

void SorStepper::set_state(int world, const model::State& state, std::int64_t step) {
  SorWorld& changed = *worlds_.at(world);
  const bool fits_pack = changed.step() == step && !changed.mends(state);
  changed.set_state(state, step);
  if (groups_.empty()) return;
  if (fits_pack && !begun_) {
    const auto [group, index] = places_.at(world);
    changed.load(*groups_[group].pack, index);
  } else {
    drop_groups();  // the joints' settings of another step, or joints that hold again
  }
}

/// As many packs as the cache asks for, of about equal size, and all but the last with whole batches of
/// lanes.
void SorStepper::make_groups() {
  places_.clear();
  int num_bodies = 0;
  for (const auto& [id, world] : worlds_) num_bodies += world->model().num_bodies();
  const int most_bodies = bodies_times_bytes_a_pack / bytes_a_number(settings_.precision);
  const int num_packs = std::max(1, (num_bodies + most_bodies / 2) / most_bodies);
  const int lanes = num_lanes(settings_.simd, settings_.precision);
  const int num_worlds = static_cast<int>(worlds_.size());
  const int worlds_a_pack = std::max(1, num_worlds / num_packs / lanes) * lanes;
  for (const auto& [id, world] : worlds_) {
    const int packed = groups_.empty() ? 0 : static_cast<int>(groups_.back().worlds.size());
    const bool full = packed >= worlds_a_pack && static_cast<int>(groups_.size()) < num_packs;
    if (groups_.empty() || full || groups_.back().worlds.front()->laws() != world->laws())
      groups_.emplace_back();
    groups_.back().worlds.push_back(world.get());
  }
  for (Group& group : groups_) {
    std::vector<PackedWorld> packed;
    for (const SorWorld* world : group.worlds)
      packed.push_back({&world->model(), find_articulations(world->model()), &world->narrow_phase(),
                        settings_.colliders == stepping::Colliders::lanes,
                        contact_margin_m(settings_, world->model())});
    group.pack = make_pack(packed, settings_.simd, settings_.precision);
    for (std::size_t i = 0; i < group.worlds.size(); ++i) {
      group.worlds[i]->enter(*group.pack, static_cast<int>(i));
      places_[group.worlds[i]->id()] = {static_cast<std::size_t>(&group - groups_.data()),
                                        static_cast<int>(i)};
    }
    group.contacts.resize(group.worlds.size());
  }
}

/// All groups stop before any goes on, so that the estimates of all worlds are there at once.
void SorStepper::begin_step(int iterations, core::PhaseTimes& times) {
  core::require_invariant(!begun_, "begin_step: the step before is finished");
  core::require_invariant(iterations >= 0 && iterations <= settings_.iterations,
                          "begin_step: no more iterations than a step has");
  if (groups_.empty()) make_groups();
  for (Group& group : groups_) {
    const double start_s = core::now_s();
    begin(group, iterations, times);
    if (!group.sleeps) {
      const PhaseMark mark(PhaseMark::MarkedPhase::forward_step);
      group.pack->iterate(iterations, times);
    }
    look(group, times);
    group.begun_s = core::now_s() - start_s;
  }
  begun_ = true;
}

void SorStepper::look(Group& group, core::PhaseTimes& times) {
  LapTimer timer(times);
  if (group.looks.empty()) {  // room for them, kept from step to step
    for (const SorWorld* world : group.worlds) {
      group.looks.push_back(world->state());
      group.looks.back().memory.clear();  // nothing goes on from a look
    }
  }
  if (!group.sleeps) {
    group.pack->look(group.looks);
    group.focused.merge_looks(group.looks);
  }
  for (std::size_t i = 0; i < group.worlds.size(); ++i) {
    group.worlds[i]->keep_sleepers(group.looks[i]);
    group.looks[i].broken_in = group.worlds[i]->state().broken_in;
  }
  timer.lap(Phase::integrate);
}

void SorStepper::begin(Group& group, std::optional<int> look_after, core::PhaseTimes& times) {
  LapTimer timer(times);
  for (std::size_t i = 0; i < group.worlds.size(); ++i)
    group.worlds[i]->begin_step(*group.pack, static_cast<int>(i));
  group.sleeps = std::none_of(group.worlds.begin(), group.worlds.end(),
                              [](const SorWorld* world) { return world->moves(); });
  if (group.sleeps) {
    for (std::vector<model::Contact>& contacts : group.contacts) contacts.clear();
    return;
  }
  collide(group);
  timer.lap(Phase::collide);
  focus(group);
  timer.lap(Phase::islands);
  // Worlds of a pack may stand at different steps only if they came to this stepper at different times; the
  // order of the rows then follows each world's own step, so it is the key of the first that all must share.
  StepParameters parameters = step_parameters(settings_, group.worlds.front()->step());
  const PhaseMark mark(PhaseMark::MarkedPhase::forward_step);
  if (group.focused.is_cut()) group.focused.step_outside(*group.pack, parameters, look_after, times);
  parameters.iterations = group.focused.iterations();
  group.pack->begin_step(group.focused.contacts(), group.focused.forces(), parameters, times);
}

void SorStepper::focus(Group& group) const {
  group.focused_worlds.clear();
  for (std::size_t i = 0; i < group.worlds.size(); ++i) {
    SorWorld& world = *group.worlds[i];
    world.before_solve(*group.pack, static_cast<int>(i), group.contacts[i]);
    group.focused_worlds.push_back({&world.model(), world.field(), group.contacts[i], world.forces()});
  }
  group.focused.begin(group.focused_worlds, settings_.iterations);
}

/// All worlds of the group collide again while bodies wake in any of them.
void SorStepper::collide(Group& group) const {
  const PhaseMark mark(PhaseMark::MarkedPhase::collision);
  group.pack->find_fast(settings_.dt_s, group.may_be_fast);
  bool woke = true;
  while (woke) {
    woke = false;
    group.pack->collide(group.contacts);
    for (std::size_t i = 0; i < group.worlds.size(); ++i)
      woke |= group.worlds[i]->after_collision(*group.pack, static_cast<int>(i), group.may_be_fast[i] != 0,
                                               group.contacts[i]);
  }
}

void SorStepper::finish(Group& group, core::PhaseTimes& times) {
  if (!group.sleeps) {
    const PhaseMark mark(PhaseMark::MarkedPhase::forward_step);
    group.pack->finish_step(times);
  }
  LapTimer timer(times);
  for (std::size_t i = 0; i < group.worlds.size(); ++i) {
    if (group.sleeps) {
      group.worlds[i]->sleep_on();
    } else {
      group.worlds[i]->after_solve(*group.pack, static_cast<int>(i), group.contacts[i], group.focused);
    }
  }
  timer.lap(Phase::islands);
}

void SorStepper::observe(Group& group, core::PhaseTimes& times) const {
  LapTimer timer(times);
  for (std::size_t i = 0; i < group.worlds.size(); ++i) {
    group.worlds[i]->observe(*group.pack, static_cast<int>(i), group.focused, group.contacts[i]);
    if (settings_.residuals)
      group.worlds[i]->observe_residuals(*group.pack, static_cast<int>(i), group.focused);
  }
  timer.lap(Phase::islands);
}

/// A pack is timed as a whole; its worlds share the time by their rows, which predict it well.
void SorStepper::share_cost(Group& group, double seconds) {
  double weights = 0;
  const auto weight = [](const SorWorld& world) {
    return world.observables().rows + std::max(1, world.num_awake());
  };
  for (const SorWorld* world : group.worlds) weights += weight(*world);
  for (SorWorld* world : group.worlds) world->cost_s = seconds * weight(*world) / weights;
}

}  // namespace

std::unique_ptr<stepping::AnytimeStepper> make_sor_stepper(const stepping::StepperSettings& settings,
                                                           model::MakeNarrowPhase make_narrow_phase) {
  require_valid(settings);
  return std::make_unique<SorStepper>(settings, std::move(make_narrow_phase));
}

}  // namespace pbmpi::solver
