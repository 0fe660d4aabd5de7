#include "solver/parts/parted_step.h"

#include <algorithm>
#include <tuple>

namespace pbmpi::solver {
namespace {

/// The least relaxing sweeps of a trial, which is one substep, if the run relaxes at all. A tall stack leans
/// a little, and when the forces lag its weight starts to tip it before the few sweeps of a substep can take
/// its speed back: it would have to be put back again and again.
constexpr int trial_relax = 6;

/// The larger of each residual.
stepping::Residuals join(const stepping::Residuals& a, const stepping::Residuals& b) {
  return {std::max(a.joint_speed, b.joint_speed), std::max(a.joint_turn, b.joint_turn),
          std::max(a.complementarity_j, b.complementarity_j), std::max(a.natural_speed, b.natural_speed),
          std::max(a.natural_turn, b.natural_turn)};
}

}  // namespace

bool PartedStep::Part::operator<(const Part& other) const {
  return std::tuple(!on_trial, substeps, iterations) <
         std::tuple(!other.on_trial, other.substeps, other.iterations);
}

bool PartedStep::Part::is_empty() const {
  return std::ranges::all_of(bodies, [](const std::vector<int>& of_world) { return of_world.empty(); });
}

void PartedStep::begin(std::span<const PartedWorld> worlds, const StepParameters& parameters) {
  worlds_.assign(worlds.begin(), worlds.end());
  parameters_ = parameters;
  fine_.begin(worlds_);
  contacts_.clear();
  for (int world = 0; world < std::ssize(worlds_); ++world) contacts_.push_back(fine_.others(world));
  parts_.clear();
  cut_ = false;
  has_last_ = true;
  if (has_parts()) sort_bodies();
}

bool PartedStep::has_parts() const {
  return std::ranges::any_of(worlds_, [](const PartedWorld& world) {
    return (world.field != nullptr && !world.field->outside().empty()) ||
           (world.shares != nullptr && world.shares->differ());
  });
}

/// If all islands get the same share, without trials, that share becomes the step's own.
void PartedStep::sort_bodies() {
  for (std::size_t w = 0; w < worlds_.size(); ++w) {
    const PartedWorld& world = worlds_[w];
    for (const int body : world.bodies) {
      Part like;
      like.on_trial = world.shares != nullptr && world.shares->is_quiet(body);
      like.substeps = world.shares != nullptr ? world.shares->substeps(body) : parameters_.substeps;
      like.iterations = world.field != nullptr ? world.field->iterations_of(body) : parameters_.iterations;
      bodies_of(like)[w].push_back(body);
      if (!like.on_trial) continue;
      like.on_trial = false;
      bodies_of(like);
    }
  }
  if (parts_.size() == 1) {
    parameters_ = parameters_of(parts_.front());
    return;
  }
  cut_ = true;
  std::ranges::sort(parts_, std::less<>());
  seen_.resize(worlds_.size());
  for (std::size_t w = 0; w < worlds_.size(); ++w) {
    const std::size_t num_joints = worlds_[w].model->joints.size();
    Seen& seen = seen_[w];
    seen.part_of_body.assign(worlds_[w].model->bodies.size(), -1);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      for (const int body : parts_[p].bodies[w])
        seen.part_of_body[static_cast<std::size_t>(body)] = static_cast<int>(p);
    }
    seen.joint_rows.assign(num_joints, -1);
    seen.reactions.assign(num_joints, {});
    seen.residuals = {};
    seen.forces.assign(contacts_[w].forces.begin(), contacts_[w].forces.end());
  }
}

std::vector<std::vector<int>>& PartedStep::bodies_of(const Part& like) {
  for (Part& known : parts_) {
    if (known.gets_as(like)) return known.bodies;
  }
  Part& fresh = parts_.emplace_back(like);
  fresh.bodies.resize(worlds_.size());
  return fresh.bodies;
}

/// A spring keeps its number of periods per substep: shorter substeps also bear stiffer springs.
StepParameters PartedStep::parameters_of(const Part& part) const {
  StepParameters parameters = parameters_;
  const double stiffer = static_cast<double>(part.substeps) / parameters.substeps;
  for (Spring* spring : {&parameters.contacts, &parameters.joint_places, &parameters.joint_turns})
    spring->frequency_hz *= stiffer;
  parameters.substeps = parameters.all_substeps = part.substeps;
  // A single substep does not push out penetration: springs as stiff as in all substeps would shake resting
  // bodies, and softer ones would let them sink. The forces that hold them are known, and their depths are
  // right.
  if (part.on_trial) {
    parameters.substeps = 1;
    parameters.pushes = false;
    if (parameters.relax > 0) parameters.relax = std::max(parameters.relax, trial_relax);
  }
  parameters.iterations = part.iterations;
  return parameters;
}

void PartedStep::activate(Pack& pack, const Part& part) const {
  for (std::size_t w = 0; w < worlds_.size(); ++w) pack.set_active(static_cast<int>(w), part.bodies[w]);
}

void PartedStep::take(Pack& pack, core::PhaseTimes& times) {
  if (!cut_) {
    step(pack, parts_.empty() ? Part{} : parts_.front(), parameters_, times);
    fine_.end();
    return;
  }
  for (std::size_t p = 0; p + 1 < parts_.size(); ++p) take_part(pack, p, times);
  const Part& last = parts_.back();
  activate(pack, last);
  has_last_ = !last.is_empty();
  if (has_last_) step(pack, last, parameters_of(last), times);
  fine_.end();
}

void PartedStep::step(Pack& pack, const Part& part, const StepParameters& parameters,
                      core::PhaseTimes& times) {
  pack.step(contacts_, parameters, fine_.begin_part(part.bodies, pack), times);
  fine_.end_part();
}

void PartedStep::take_part(Pack& pack, std::size_t part, core::PhaseTimes& times) {
  if (parts_[part].is_empty()) return;
  activate(pack, parts_[part]);
  step(pack, parts_[part], parameters_of(parts_[part]), times);
  if (parts_[part].on_trial) judge(pack, part);
  for (std::size_t w = 0; w < worlds_.size(); ++w) {
    if (!parts_[part].bodies[w].empty()) note(pack, static_cast<int>(w), static_cast<int>(part));
  }
}

void PartedStep::judge(Pack& pack, std::size_t part) {
  for (std::size_t w = 0; w < worlds_.size(); ++w) {
    const std::vector<int>& bodies = parts_[part].bodies[w];
    if (bodies.empty()) continue;
    const PartedWorld& world = worlds_[w];
    pack.store(static_cast<int>(w), bodies, *world.after);
    far_.clear();
    world.shares->judge(bodies, *world.before, *world.after, far_);
    if (!far_.empty()) put_back(pack, static_cast<int>(w), far_, part);
  }
}

/// Puts bodies that have moved too far back to before the step, and into the part that gives them all
/// substeps.
void PartedStep::put_back(Pack& pack, int world, std::span<const int> far, std::size_t part) {
  const auto w = static_cast<std::size_t>(world);
  const Part like = {.substeps = parts_[part].substeps, .iterations = parts_[part].iterations};
  const auto rest = std::ranges::find_if(parts_, [&](const Part& other) { return other.gets_as(like); });
  const int rest_index = static_cast<int>(rest - parts_.begin());
  Seen& seen = seen_[w];
  pack.load(world, far, *worlds_[w].before);
  for (const int body : far) seen.part_of_body[static_cast<std::size_t>(body)] = rest_index;
  rest->bodies[w].insert(rest->bodies[w].end(), far.begin(), far.end());
  std::erase_if(parts_[part].bodies[w],
                [&](int body) { return seen.part_of_body[static_cast<std::size_t>(body)] == rest_index; });
  for (std::size_t i = 0; i < seen.forces.size(); ++i) {
    if (seen.part_of_body[static_cast<std::size_t>(contacts_[w].contacts[i].body_a)] == rest_index)
      contacts_[w].forces[i] = seen.forces[i];
  }
}

/// Called before the next part, for which batches with bodies of several parts get new rows.
void PartedStep::note(const Pack& pack, int world, int part) {
  const auto w = static_cast<std::size_t>(world);
  const model::Model& model = *worlds_[w].model;
  Seen& seen = seen_[w];
  for (std::size_t joint = 0; joint < model.joints.size(); ++joint) {
    if (seen.part_of_body[static_cast<std::size_t>(model.joints[joint].body_a)] != part) continue;
    seen.joint_rows[joint] = pack.joint_rows(world, static_cast<int>(joint));
    if (model.joints[joint].breakable())
      seen.reactions[joint] = pack.reaction(world, static_cast<int>(joint));
  }
  if (parameters_.residuals) seen.residuals = join(seen.residuals, pack.residuals(world));
}

int PartedStep::joint_rows(const Pack& pack, int world, int joint) const {
  const int noted =
      cut_ ? seen_[static_cast<std::size_t>(world)].joint_rows[static_cast<std::size_t>(joint)] : -1;
  return noted < 0 ? pack.joint_rows(world, joint) : noted;
}

effects::Reaction PartedStep::reaction(const Pack& pack, int world, int joint) const {
  if (!cut_) return pack.reaction(world, joint);
  const Seen& seen = seen_[static_cast<std::size_t>(world)];
  const auto index = static_cast<std::size_t>(joint);
  return seen.joint_rows[index] >= 0 ? seen.reactions[index] : pack.reaction(world, joint);
}

stepping::Residuals PartedStep::residuals(const Pack& pack, int world) const {
  if (!cut_) return pack.residuals(world);
  const stepping::Residuals& noted = seen_[static_cast<std::size_t>(world)].residuals;
  return has_last_ ? join(noted, pack.residuals(world)) : noted;
}

int PartedStep::sweeps(int world, int body) const {
  const auto sweeps_of = [](const StepParameters& parameters) {
    return parameters.substeps * (parameters.iterations + parameters.relax);
  };
  if (!cut_) return sweeps_of(parameters_);
  const int part = seen_[static_cast<std::size_t>(world)].part_of_body[static_cast<std::size_t>(body)];
  if (part < 0) return 0;
  return sweeps_of(parameters_of(parts_[static_cast<std::size_t>(part)]));
}

}  // namespace pbmpi::solver
