/// A step of a pack in which some islands get more or fewer substeps, or iterations, than others, or contacts
/// of their own in each piece of the step.
#pragma once

#include <span>
#include <vector>

#include "core/clock.h"
#include "effects/field_of_interest.h"
#include "solver/contacts/contact_recall.h"
#include "solver/pack/pack.h"
#include "solver/parts/island_shares.h"

namespace pbmpi::solver {

/// A world of the pack as it enters a step.
struct PartedWorld {
  const model::Model* model = nullptr;
  std::span<const int> bodies;     ///< the bodies that are to move
  model::SolvedContacts contacts;  ///< between these bodies, and approaches
  /// The field that has sorted the bodies; null without the effect.
  const effects::FieldOfInterest* field = nullptr;
  /// The shares that have sorted the bodies; null where all islands get the same.
  IslandShares* shares = nullptr;
  /// With `shares`: the world before the step, at least its quiet bodies and the joints' forces; and room for
  /// these bodies' poses and velocities after the step.
  const model::State* before = nullptr;
  model::State* after = nullptr;
};

/// Where islands get different shares of a step, the step is taken part by part, each time with the bodies of
/// one part active: first quiet islands, which are on trial, then the rest together with failed trials,
/// fewest substeps and iterations first. An island gets the same bits as in a pack without the other islands.
///
/// Fine islands take the step in pieces (fine_islands.h): from the second on with the contacts that they then
/// have, which start with the forces of the piece before.
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

  /// Did fine islands take the step? Then its contacts have changed on the way.
  bool has_fine() const { return has_fine_; }
  /// With has_fine(), after take(): the contacts of a world and their forces as the step ended, without
  /// approaches; valid until the next begin().
  model::SolvedContacts ended(int world) { return fine_[static_cast<std::size_t>(world)].ended.solved(); }
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
    int pieces = 1;                             ///< of the step, with contacts of their own
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
  /// Contacts of a world with their forces.
  struct OwnContacts {
    std::vector<model::Contact> contacts;
    std::vector<model::ContactForce> forces;

    void clear();
    void add(const model::SolvedContacts& from, std::size_t index);
    /// Adds others, too, in canonical order.
    void merge(const model::SolvedContacts& from);
    model::SolvedContacts solved() { return {contacts, forces}; }
  };
  /// A world with fine islands.
  struct Fine {
    OwnContacts now;    ///< of the part and piece that is being taken
    OwnContacts ended;  ///< of all parts, as the step ends
    ContactRecall recall;
  };

  bool has_parts() const;
  void sort_bodies();
  /// The bodies [num_worlds] of the part that gets the same share as `like`.
  std::vector<std::vector<int>>& bodies_of(const Part& like);
  StepParameters parameters_of(const Part& part) const;
  void activate(Pack& pack, const Part& part) const;
  void step(Pack& pack, std::size_t part, core::PhaseTimes& times);
  void start_pieces(std::size_t part);
  void collide(Pack& pack, const Part& part, double piece_s);
  void end_pieces();
  void end_fine();
  bool is_in(std::size_t part, std::size_t world, const model::Contact& contact) const;
  void take_part(Pack& pack, std::size_t part, core::PhaseTimes& times);
  void judge(Pack& pack, std::size_t part);
  void put_back(Pack& pack, int world, std::span<const int> far, std::size_t part);
  void note(const Pack& pack, int world, int part);

  std::vector<PartedWorld> worlds_;
  StepParameters parameters_;
  std::vector<model::SolvedContacts> contacts_;  ///< [num_worlds]
  std::vector<Part> parts_;                      ///< of a step that is cut
  std::vector<Seen> seen_;                       ///< [num_worlds] of a step that is cut
  std::vector<Fine> fine_;                       ///< [num_worlds] of a step with fine islands
  std::vector<model::SolvedContacts> piece_;     ///< [num_worlds] those of the current piece
  std::vector<int> far_;                         ///< scratch
  bool has_fine_ = false;
  bool cut_ = false;
  bool has_last_ = true;  ///< has the last part any bodies?
};

}  // namespace pbmpi::solver
