/// Counts what a step has to solve: rows and islands.
#pragma once

#include <vector>

#include "bullet/collide/contacts.h"
#include "bullet/objects/axis_joints.h"
#include "model/islands.h"
#include "model/state.h"
#include "stepping/observables.h"

namespace pbmpi::bullet {

/// Counts from the joints and contacts, between collision detection and the solver.
class RowCounter {
 public:
  /// Both are borrowed.
  RowCounter(const model::Model& model, AxisJoints& joints);

  /// Sets rows, islands and max_island_rows. `state`: its `rest` and `broken_in` are current; sleeping bodies
  /// have no rows.
  void count(const std::vector<Touch>& touches, const model::State& state,
             stepping::Observables& observables);

 private:
  /// Rows between two bodies, either of which may be no_body.
  struct Link {
    int body_a, body_b, rows;
  };
  void collect(const std::vector<Touch>& touches, const model::State& state);

  const model::Model* model_;
  AxisJoints* joints_;
  std::vector<Link> links_;
  model::DisjointSets sets_;
  std::vector<int> set_rows_;  ///< [num_bodies], at the lowest body of each island
};

}  // namespace pbmpi::bullet
