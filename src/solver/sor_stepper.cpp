#include "solver/sor_stepper.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "solver/articulation.h"
#include "solver/sor_world.h"
#include "solver/step_settings.h"

namespace pbmpi::solver {
namespace {

using core::LapTimer;
using core::Phase;

/// Bytes of velocities and rows that a pack may have for each body, about: what a sweep reads again and again
/// should stay in a core's second cache (measured on 100CrSk: 500 to 2,000 bodies in float are alike, twice
/// as many cost a tenth; in double half as many).
constexpr int bytes_a_number(model::Precision precision) {
  return precision == model::Precision::single ? 4 : 8;
}
constexpr int bodies_times_bytes_a_pack = 7200;

/// What the worlds of a pack must have in common.
bool same_laws(const model::Model& a, const model::Model& b) {
  return a.erp == b.erp && a.cfm == b.cfm && a.contact_law.soft_erp == b.contact_law.soft_erp &&
         a.contact_law.soft_cfm == b.contact_law.soft_cfm &&
         a.contact_law.bounce_velocity == b.contact_law.bounce_velocity;
}

/// Worlds that are stepped together.
struct Group {
  std::vector<SorWorld*> worlds;
  std::unique_ptr<Pack> pack;
  std::vector<std::vector<model::Contact>> contacts;  ///< [worlds] of this step
  std::vector<std::span<const model::Contact>> contact_spans;
};

class SorStepper final : public model::WorldStepper {
 public:
  SorStepper(const model::StepperSettings& settings, model::MakeNarrowPhase make_narrow_phase)
      : settings_(settings), make_narrow_phase_(std::move(make_narrow_phase)) {}

  void add(int world, std::shared_ptr<const model::Model> model, const model::State& state,
           std::int64_t step) override {
    worlds_.emplace(world, std::make_unique<SorWorld>(world, std::move(model), state, step, settings_.dt_s,
                                                      make_narrow_phase_));
    groups_.clear();
  }
  void remove(int world) override {
    worlds_.erase(world);
    groups_.clear();
  }
  void set_state(int world, const model::State& state, std::int64_t step) override;
  const model::State& state(int world) const override { return worlds_.at(world)->state(); }
  const model::Model& model(int world) const override { return worlds_.at(world)->model(); }
  const model::Observables& observables(int world) const override { return worlds_.at(world)->observables(); }
  double cost_s(int world) const override { return worlds_.at(world)->cost_s; }

  void advance(int num_steps, core::PhaseTimes& times) override {
    if (groups_.empty()) make_groups();
    for (Group& group : groups_) {
      const double start_s = core::now_s();
      for (int i = 0; i < num_steps; ++i) step(group, times);
      observe(group, times);
      share_cost(group, core::now_s() - start_s);
    }
  }

 private:
  void make_groups();
  void step(Group& group, core::PhaseTimes& times);
  static bool wake_touched(Group& group);
  static void observe(Group& group, core::PhaseTimes& times);
  static void share_cost(Group& group, double seconds);

  model::StepperSettings settings_;
  model::MakeNarrowPhase make_narrow_phase_;
  std::map<int, std::unique_ptr<SorWorld>> worlds_;
  std::vector<Group> groups_;                          ///< empty: to be made anew
  std::map<int, std::pair<std::size_t, int>> places_;  ///< world -> its group, and its index there
};

void SorStepper::set_state(int world, const model::State& state, std::int64_t step) {
  SorWorld& changed = *worlds_.at(world);
  const bool same_step = changed.step() == step;
  changed.set_state(state, step);
  if (groups_.empty()) return;
  if (same_step) {
    const auto [group, index] = places_.at(world);
    changed.load(*groups_[group].pack, index);
  } else {
    groups_.clear();  // the joints' settings of another step
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
    if (groups_.empty() || full || !same_laws(groups_.back().worlds.front()->model(), world->model()))
      groups_.emplace_back();
    groups_.back().worlds.push_back(world.get());
  }
  for (Group& group : groups_) {
    std::vector<PackedWorld> packed;
    for (const SorWorld* world : group.worlds)
      packed.push_back({&world->model(), find_articulations(world->model()), &world->narrow_phase(),
                        settings_.colliders == model::Colliders::lanes});
    group.pack = make_pack(packed, settings_.simd, settings_.precision);
    for (std::size_t i = 0; i < group.worlds.size(); ++i) {
      group.worlds[i]->enter(*group.pack, static_cast<int>(i));
      places_[group.worlds[i]->id()] = {static_cast<std::size_t>(&group - groups_.data()),
                                        static_cast<int>(i)};
    }
    group.contacts.resize(group.worlds.size());
    group.contact_spans.resize(group.worlds.size());
  }
}

void SorStepper::step(Group& group, core::PhaseTimes& times) {
  LapTimer timer(times);
  for (std::size_t i = 0; i < group.worlds.size(); ++i)
    group.worlds[i]->fire_events(*group.pack, static_cast<int>(i));
  if (std::none_of(group.worlds.begin(), group.worlds.end(), [](const auto* w) { return w->moves(); })) {
    for (std::vector<model::Contact>& contacts : group.contacts) contacts.clear();
    for (SorWorld* world : group.worlds) world->finish_step();
    return;
  }
  do {
    group.pack->collide(group.contacts);
  } while (wake_touched(group));
  std::copy(group.contacts.begin(), group.contacts.end(), group.contact_spans.begin());
  timer.lap(Phase::collide);
  // Worlds of a pack may stand at different steps only if they came to this stepper at different times; the
  // order of the rows then follows each world's own step, so it is the key of the first that all must share.
  group.pack->step(group.contact_spans, step_parameters(settings_, group.worlds.front()->step()), times);
  core::LapTimer after(times);
  for (std::size_t i = 0; i < group.worlds.size(); ++i) {
    group.worlds[i]->finish_step();
    group.worlds[i]->settle(*group.pack, static_cast<int>(i), group.contacts[i]);
  }
  after.lap(Phase::islands);
}

/// Wakes what is touched in any world of the group.
bool SorStepper::wake_touched(Group& group) {
  bool any = false;
  for (std::size_t i = 0; i < group.worlds.size(); ++i)
    any |= group.worlds[i]->wake_touched(*group.pack, static_cast<int>(i), group.contacts[i]);
  return any;
}

void SorStepper::observe(Group& group, core::PhaseTimes& times) {
  LapTimer timer(times);
  for (std::size_t i = 0; i < group.worlds.size(); ++i)
    group.worlds[i]->observe(*group.pack, static_cast<int>(i), group.contacts[i]);
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

std::unique_ptr<model::WorldStepper> make_sor_stepper(const model::StepperSettings& settings,
                                                      model::MakeNarrowPhase make_narrow_phase) {
  require_valid(settings);
  return std::make_unique<SorStepper>(settings, std::move(make_narrow_phase));
}

}  // namespace pbmpi::solver
