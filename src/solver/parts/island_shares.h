/// Which islands of a world get more or fewer substeps than the run's number, or take the step in pieces.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/contact.h"
#include "model/model.h"
#include "model/state.h"
#include "solver/parts/fine_islands.h"
#include "solver/parts/quiet_islands.h"
#include "solver/parts/step_islands.h"
#include "solver/parts/tall_islands.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

class IslandShares {
 public:
  /// None where all islands get the same. `model` is borrowed.
  static std::optional<IslandShares> find(const model::Model& model,
                                          const stepping::StepperSettings& settings);

  /// Does sort() need poses and velocities?
  bool wants_state() const { return quiet_.has_value(); }
  /// Can any island get more substeps?
  bool may_add_substeps() const { return tall_.has_value(); }
  /// May these contacts make an island take the step in pieces?
  bool may_cut(std::span<const model::Contact> contacts) const {
    return fine_ && std::ranges::any_of(contacts, &model::Contact::is_approach);
  }
  /// Sorts these bodies, which are whole islands of joints and contacts. `broken_in`: State::broken_in;
  /// `before`: the state that wants_state() asks for.
  void sort(std::span<const int> bodies, std::span<const model::Contact> contacts,
            std::span<const std::int32_t> broken_in, const model::State& before);
  /// Does any body get another share than the run's?
  bool differ() const { return any_fine_ || any_tall_ || (quiet_ && !quiet_->bodies().empty()); }
  /// Does any island take the step in pieces?
  bool any_fine() const { return any_fine_; }
  /// The pieces into which a body's island cuts the step (fine_islands.h); 1: none.
  int pieces(int body) const { return any_fine_ ? fine_->pieces(body) : 1; }
  bool is_quiet(int body) const { return quiet_ && quiet_->contains(body) && pieces(body) == 1; }
  /// The substeps of a body that is not quiet.
  int substeps(int body) const { return any_tall_ ? tall_->substeps(body) : substeps_; }
  /// The bodies in quiet islands, in the order in which they were given.
  std::span<const int> quiet_bodies() const { return quiet_ ? quiet_->bodies() : std::span<const int>(); }
  void sort_by_island(std::vector<int>& fine_bodies) const { fine_->sort_by_island(fine_bodies); }
  /// FineIslands::collide()
  void collide(Pack& pack, int world, std::span<const int> bodies, double piece_s,
               std::vector<model::Contact>& contacts) {
    fine_->collide(pack, world, bodies, piece_s, contacts);
  }
  /// QuietIslands::judge() for quiet bodies, which are whole islands.
  void judge(std::span<const int> bodies, const model::State& before, const model::State& after,
             std::vector<int>& far) {
    quiet_->judge(bodies, islands_, before, after, far);
  }

 private:
  IslandShares(const model::Model& model, const stepping::StepperSettings& settings);

  int substeps_;
  StepIslands islands_;
  std::optional<QuietIslands> quiet_;
  std::optional<TallIslands> tall_;
  std::optional<FineIslands> fine_;
  bool any_tall_ = false, any_fine_ = false;
};

}  // namespace pbmpi::solver
