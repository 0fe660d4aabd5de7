#include "solver/pack/focused_step.h"

#include <algorithm>

#include "core/error.h"

namespace pbmpi::solver {
namespace {

/// The larger of each.
stepping::Residuals join(const stepping::Residuals& a, const stepping::Residuals& b) {
  return {std::max(a.joint_speed, b.joint_speed), std::max(a.joint_turn, b.joint_turn),
          std::max(a.complementarity_j, b.complementarity_j), std::max(a.natural_speed, b.natural_speed),
          std::max(a.natural_turn, b.natural_turn)};
}

}  // namespace

void FocusedStep::begin(std::span<const FocusedWorld> worlds, int iterations) {
  worlds_.assign(worlds.begin(), worlds.end());
  contacts_.clear();
  forces_.clear();
  bool any_inside = false, any_outside = false, all_have_fields = true;
  iterations_ = outside_iterations_ = iterations;
  for (const FocusedWorld& world : worlds_) {
    contacts_.push_back(world.contacts);
    forces_.push_back(world.forces);
    all_have_fields &= world.field != nullptr;
    any_inside |= world.field == nullptr || !world.field->inside().empty();
    if (world.field == nullptr || world.field->outside().empty()) continue;
    any_outside = true;
    outside_iterations_ = world.field->outside_iterations();
  }
  core::require_invariant(all_have_fields || !any_outside,
                          "the worlds of a pack all have a field of interest");
  cut_ = any_inside && any_outside && outside_iterations_ < iterations;
  if (!any_inside) iterations_ = outside_iterations_;
}

void FocusedStep::begin_outside(Pack& pack, StepParameters parameters, core::PhaseTimes& times) {
  parameters.iterations = outside_iterations_;
  for (std::size_t w = 0; w < worlds_.size(); ++w)
    pack.set_active(static_cast<int>(w), worlds_[w].field->outside());
  pack.begin_step(contacts_, forces_, parameters, times);
}

void FocusedStep::finish_outside(Pack& pack, bool residuals, core::PhaseTimes& times) {
  pack.finish_step(times);
  seen_.resize(worlds_.size());
  for (std::size_t w = 0; w < worlds_.size(); ++w) {
    note(pack, static_cast<int>(w));
    if (residuals) seen_[w].residuals = pack.residuals(static_cast<int>(w));
    pack.set_active(static_cast<int>(w), worlds_[w].field->inside());
  }
}

/// Batches with bodies of both sorts get their rows anew for what is inside.
void FocusedStep::note(const Pack& pack, int world) {
  const FocusedWorld& one = worlds_[static_cast<std::size_t>(world)];
  std::vector<int>& rows = seen_[static_cast<std::size_t>(world)].joint_rows;
  rows.assign(one.model->joints.size(), -1);
  std::vector<effects::Reaction>& reactions = seen_[static_cast<std::size_t>(world)].reactions;
  reactions.assign(rows.size(), {});
  for (std::size_t joint = 0; joint < rows.size(); ++joint) {
    if (one.field->contains(one.model->joints[joint].body_a)) continue;
    rows[joint] = pack.joint_rows(world, static_cast<int>(joint));
    if (one.model->joints[joint].breakable())
      reactions[joint] = pack.reaction(world, static_cast<int>(joint));
  }
}

void FocusedStep::step_outside(Pack& pack, const StepParameters& parameters, std::optional<int> look_after,
                               core::PhaseTimes& times) {
  begin_outside(pack, parameters, times);
  if (look_after) {
    pack.iterate(*look_after, times);
    looks_.resize(worlds_.size());
    for (std::size_t w = 0; w < worlds_.size(); ++w) looks_[w].resize(worlds_[w].model->num_bodies());
    pack.look(looks_);
  }
  finish_outside(pack, parameters.residuals, times);
}

void FocusedStep::merge_looks(std::span<model::State> looks) const {
  for (std::size_t w = 0; cut_ && w < worlds_.size(); ++w) {
    for (const int body : worlds_[w].field->outside()) model::copy_body(body, looks_[w], looks[w]);
  }
}

int FocusedStep::joint_rows(const Pack& pack, int world, int joint) const {
  const int outside =
      cut_ ? seen_[static_cast<std::size_t>(world)].joint_rows[static_cast<std::size_t>(joint)] : -1;
  return outside < 0 ? pack.joint_rows(world, joint) : outside;
}

effects::Reaction FocusedStep::reaction(const Pack& pack, int world, int joint) const {
  if (!cut_) return pack.reaction(world, joint);
  const Seen& seen = seen_[static_cast<std::size_t>(world)];
  const auto index = static_cast<std::size_t>(joint);
  return seen.joint_rows[index] >= 0 ? seen.reactions[index] : pack.reaction(world, joint);
}

stepping::Residuals FocusedStep::residuals(const Pack& pack, int world) const {
  const stepping::Residuals rest = pack.residuals(world);
  return cut_ ? join(seen_[static_cast<std::size_t>(world)].residuals, rest) : rest;
}

}  // namespace pbmpi::solver
