/// Counts what a step has to solve: rows and islands.
#pragma once

#include <functional>
#include <vector>

#include "model/islands.h"
#include "model/state.h"
#include "stepping/engine/touch.h"
#include "stepping/observables.h"
#include "stepping/step_profile.h"

namespace pbmpi::stepping {

/// Counts from the joints and contacts, for engines that show neither their rows nor their islands. To be
/// used between collision detection and the solver, since limits become active according to the poses before
/// the step.
class RowCounter {
 public:
  /// Scalar rows of a joint in the step.
  using RowsOfJoint = std::function<int(int joint)>;

  /// `model` is borrowed.
  explicit RowCounter(const model::Model& model) : model_(&model), sets_(model.num_bodies()) {}

  /// Sets rows, islands and max_island_rows. `state`: its `rest` and `broken_in` are current; sleeping bodies
  /// have no rows.
  void count(const std::vector<Touch>& touches, const model::State& state, const RowsOfJoint& rows_of_joint,
             Observables& observables);
  /// Sum over the islands of the last count() of their rows times their sweeps; sweeps(body) is called with
  /// an island's lowest body.
  template <class Sweeps>
  double row_visits(Sweeps sweeps) const {
    double visits = 0;
    for (std::size_t body = 0; body < set_rows_.size(); ++body) {
      if (set_rows_[body] > 0)
        visits += static_cast<double>(set_rows_[body]) * sweeps(static_cast<int>(body));
    }
    return visits;
  }
  /// The islands of the last count(), in order of their lowest body, without times.
  std::vector<IslandCost> islands(const std::vector<Touch>& touches);
  /// The lowest body of the island that contained `body`.
  int island_of(int body) { return sets_.find(body); }

 private:
  /// Rows between two bodies, either of which may be no_body.
  struct Link {
    int body_a, body_b, rows;
  };
  void collect(const std::vector<Touch>& touches, const model::State& state,
               const RowsOfJoint& rows_of_joint);

  const model::Model* model_;
  std::vector<Link> links_;
  model::DisjointSets sets_;
  std::vector<int> set_rows_;  ///< [num_bodies], at the lowest body of each island
};

}  // namespace pbmpi::stepping
