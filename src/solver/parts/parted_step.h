/// A step of a pack in which some islands get more or fewer substeps, or iterations, than others, or contacts
/// of their own in each piece of the step.
#pragma once

#include <span>
#include <vector>

#include "core/clock.h"
#include "solver/pack/pack.h"
#include "solver/parts/fine_contacts.h"
#include "solver/parts/parted_world.h"

namespace pbmpi::solver {

/// Where islands get different shares of a step, the step is taken part by part, each time with the bodies of
/// one part active: first quiet islands, which are on trial, then the rest together with failed trials,
/// fewest substeps and iterations first. An island gets the same bits as in a pack without the other islands.
///
/// Fine islands take their part of the step with all others, but get contacts of their own in each piece of
/// it (fine_islands.h).
///
/// A step is begin() and take().
class PartedStep {
 public:
  /// Begins a step with the run's parameters. The spans must live until the step is taken.
  void begin(std::span<const PartedWorld> worlds, const StepParameters& parameters);
  /// Does the step have more than one part? After take() the bodies of the last part are active.
  bool is_cut() const { return cut_; }

  /// Takes the step, the last part last.
  void take(Pack& pack, core::PhaseTimes& times);

  /// Has a world fine islands? Then its contacts change on the way.
  bool has_fine(int world) const { return fine_.any(world); }
  /// With has_fine(), after take(): the contacts of a world and their forces as the step ended, without
  /// approaches; valid until the next begin().
  model::SolvedContacts ended(int world) { return fine_.ended(world); }
  /// As in Pack, for the whole step; valid until the next begin().
  int joint_rows(const Pack& pack, int world, int joint) const;
  /// Failed trials count too.
  stepping::Residuals residuals(const Pack& pack, int world) const;
  effects::Reaction reaction(const Pack& pack, int world, int joint) const;
  /// Sweeps that the rows of a body got in the step, relaxing ones included.
  int sweeps(int world, int body) const;

 private:
  struct Part {
    bool on_trial = false;  ///< one substep
    int substeps = 1;       ///< unless on trial; more substeps than the run's mean stiffer springs
    int iterations = 1;
    std::vector<std::vector<int>> bodies = {};  ///< [num_worlds]

    bool operator<(const Part& other) const;
    bool gets_as(const Part& other) const { return !(*this < other) && !(other < *this); }
    bool is_empty() const;
  };
  /// What is kept of a world's parts when the pack goes on to the next part.
  struct Seen {
    std::vector<int> part_of_body;             ///< [num_bodies]; -1: the body does not move
    std::vector<int> joint_rows;               ///< [joints] for all parts except the last, else -1
    std::vector<effects::Reaction> reactions;  ///< [joints] likewise, for joints that can break
    stepping::Residuals residuals;
    std::vector<model::ContactForce> forces;  ///< with which the contacts start
  };
  bool has_parts() const;
  void sort_bodies();
  /// The bodies [num_worlds] of the part that gets the same share as `like`.
  std::vector<std::vector<int>>& bodies_of(const Part& like);
  StepParameters parameters_of(const Part& part) const;
  void activate(Pack& pack, const Part& part) const;
  void step(Pack& pack, const Part& part, const StepParameters& parameters, core::PhaseTimes& times);
  void take_part(Pack& pack, std::size_t part, core::PhaseTimes& times);
  void judge(Pack& pack, std::size_t part);
  void put_back(Pack& pack, int world, std::span<const int> far, std::size_t part);
  void note(const Pack& pack, int world, int part);

  std::vector<PartedWorld> worlds_;
  StepParameters parameters_;
  std::vector<model::SolvedContacts> contacts_;  ///< [num_worlds] but for those of fine islands
  std::vector<Part> parts_;                      ///< none where all islands get the same
  std::vector<Seen> seen_;                       ///< [num_worlds] of a step that is cut
  FineContacts fine_;
  std::vector<int> far_;  ///< scratch
  bool cut_ = false;
  bool has_last_ = true;  ///< has the last part any bodies?
};

}  // namespace pbmpi::solver
