/// A step of a pack in which islands outside of a field of interest get fewer iterations.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/clock.h"
#include "effects/field_of_interest.h"
#include "solver/pack/pack.h"

namespace pbmpi::solver {

/// A world of the pack as it enters a step.
struct FocusedWorld {
  const model::Model* model = nullptr;
  /// Has sorted the bodies that are to move; null without the effect, and then for all worlds of a
  /// pack.
  const effects::FieldOfInterest* field = nullptr;
  std::span<const model::Contact> contacts;  ///< between these bodies, in canonical order
  std::span<model::ContactForce> forces;     ///< [contacts] or none: see Pack::step()
};

/// Where bodies of both sorts are to move, the step is taken twice, each time with those of one sort
/// active: first what is outside, from beginning to end; then the pack is left before the step of
/// what is inside. An island has the bits that a pack without the other islands would give it.
class FocusedStep {
 public:
  using Contacts = Pack::Contacts;

  /// Begins a step in a run with so many iterations. The spans must live until the step is taken.
  void begin(std::span<const FocusedWorld> worlds, int iterations);
  /// Are there bodies of both sorts?
  bool is_cut() const { return cut_; }
  /// For the bodies that step_outside() leaves; for all, if it is not cut.
  int iterations() const { return iterations_; }
  Contacts contacts() const { return contacts_; }
  Pack::Forces forces() const { return forces_; }

  /// If it is cut: moves what is outside, and makes what is inside active. With `look_after`: sees the former
  /// as it would be after so many iterations.
  void step_outside(Pack& pack, const StepParameters& parameters, std::optional<int> look_after,
                    core::PhaseTimes& times);
  /// Copies the bodies outside, as step_outside() saw them, into looks at the rest.
  void merge_looks(std::span<model::State> looks) const;

  /// As in Pack, but for the whole step; valid until the next begin().
  int joint_rows(const Pack& pack, int world, int joint) const;
  stepping::Residuals residuals(const Pack& pack, int world) const;
  effects::Reaction reaction(const Pack& pack, int world, int joint) const;

 private:
  struct Seen {
    std::vector<int> joint_rows;               ///< [joints] of what is outside, else -1
    std::vector<effects::Reaction> reactions;  ///< [joints] of those that can break and are outside
    stepping::Residuals residuals;
  };
  void begin_outside(Pack& pack, StepParameters parameters, core::PhaseTimes& times);
  void finish_outside(Pack& pack, bool residuals, core::PhaseTimes& times);
  void note(const Pack& pack, int world);

  std::vector<FocusedWorld> worlds_;
  std::vector<std::span<const model::Contact>> contacts_;  ///< [num_worlds]
  std::vector<std::span<model::ContactForce>> forces_;     ///< [num_worlds]
  std::vector<Seen> seen_;                                 ///< [num_worlds] of what is outside
  std::vector<model::State> looks_;
  bool cut_ = false;
  int iterations_ = 0, outside_iterations_ = 0;
};

}  // namespace pbmpi::solver
