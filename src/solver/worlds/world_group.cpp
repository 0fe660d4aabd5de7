#include "solver/worlds/world_group.h"

#include <algorithm>
#include <utility>

#include "core/marks.h"
#include "solver/layout/articulation.h"
#include "solver/pack/simd.h"
#include "solver/pack/step_settings.h"

namespace pbmpi::solver {

using core::LapTimer;
using core::Phase;
using core::PhaseMark;

WorldGroup::WorldGroup(std::vector<SorWorld*> worlds, const stepping::StepperSettings& settings)
    : worlds_(std::move(worlds)), settings_(&settings), contacts_(worlds_.size()) {
  std::vector<PackedWorld> packed;
  for (const SorWorld* world : worlds_)
    packed.push_back({&world->model(), find_articulations(world->model()), &world->narrow_phase(),
                      settings.law.colliders == stepping::Colliders::lanes,
                      contact_margin_m(settings, world->model()), most_approach_m(settings),
                      world->moves_in_parts()});
  pack_ = make_pack(packed, settings.simd, settings.precision);
  for (std::size_t i = 0; i < worlds_.size(); ++i) worlds_[i]->enter(*pack_, static_cast<int>(i));
}

bool WorldGroup::stands_at_one_step() const {
  const std::int64_t step = worlds_.front()->step();
  return std::ranges::all_of(worlds_, [&](const SorWorld* world) { return world->step() == step; });
}

void WorldGroup::advance(int num_steps, core::PhaseTimes& times) {
  const double start_s = core::now_s();
  for (int i = 0; i < num_steps; ++i) step(times);
  observe(times);
  spent_s_ = core::now_s() - start_s;
}

void WorldGroup::step(core::PhaseTimes& times) {
  LapTimer timer(times);
  for (std::size_t i = 0; i < worlds_.size(); ++i) worlds_[i]->begin_step(*pack_, static_cast<int>(i));
  if (std::ranges::none_of(worlds_, [](const SorWorld* world) { return world->moves(); })) {
    for (std::vector<model::Contact>& contacts : contacts_) contacts.clear();
    for (SorWorld* world : worlds_) world->sleep_on();
    timer.lap(Phase::islands);
    return;
  }
  collide();
  timer.lap(Phase::collide);
  part();
  timer.lap(Phase::islands);
  {
    const PhaseMark mark(PhaseMark::MarkedPhase::forward_step);
    parted_.take(*pack_, times);
  }
  end_step(times);
}

void WorldGroup::end_step(core::PhaseTimes& times) {
  LapTimer timer(times);
  for (std::size_t i = 0; i < worlds_.size(); ++i)
    worlds_[i]->after_solve(*pack_, static_cast<int>(i), contacts_[i], parted_);
  timer.lap(Phase::islands);
}

void WorldGroup::part() {
  if (spares_substeps(*settings_)) pack_->find_slow(settings_->dt_s, settings_->tolerance_m, may_be_slow_);
  parted_worlds_.clear();
  for (std::size_t i = 0; i < worlds_.size(); ++i) {
    const bool may_be_slow = !may_be_slow_.empty() && may_be_slow_[i] != 0;
    worlds_[i]->before_solve(*pack_, static_cast<int>(i), may_be_slow, contacts_[i]);
    parted_worlds_.push_back(worlds_[i]->parted(contacts_[i]));
  }
  // The order of the rows follows from the step, which is the same for all worlds, or is always the same.
  parted_.begin(parted_worlds_, step_parameters(*settings_, worlds_.front()->step()));
}

/// All worlds of the group collide again while bodies wake in any of them.
void WorldGroup::collide() {
  const PhaseMark mark(PhaseMark::MarkedPhase::collision);
  pack_->find_fast(settings_->dt_s, may_be_fast_);
  bool woke = true;
  while (woke) {
    woke = false;
    pack_->collide(contacts_);
    for (std::size_t i = 0; i < worlds_.size(); ++i)
      woke |= worlds_[i]->after_collision(*pack_, static_cast<int>(i), may_be_fast_[i] != 0, contacts_[i]);
  }
}

void WorldGroup::observe(core::PhaseTimes& times) {
  LapTimer timer(times);
  for (std::size_t i = 0; i < worlds_.size(); ++i) {
    worlds_[i]->observe(*pack_, static_cast<int>(i), parted_, contacts_[i]);
    if (settings_->residuals) worlds_[i]->observe_residuals(*pack_, static_cast<int>(i), parted_);
  }
  timer.lap(Phase::islands);
}

void WorldGroup::share_cost(double share) {
  double weights = 0;
  const auto weight = [this](const SorWorld& world) {
    return world.observables().row_visits / sweeps_of(*settings_) + std::max(1, world.num_awake());
  };
  for (const SorWorld* world : worlds_) weights += weight(*world);
  const double cost_s = share * spent_s_;
  for (SorWorld* world : worlds_) world->cost_s = cost_s * weight(*world) / weights;
}

}  // namespace pbmpi::solver
