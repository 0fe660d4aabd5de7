/// Counts what a step has to solve: rows and islands.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/islands.h"
#include "model/state.h"
#include "ode/collide/contacts.h"
#include "stepping/observables.h"
#include "stepping/step_profile.h"

namespace pbmpi::ode {

/// ODE exposes neither its rows nor its islands; this counts both from the joints and contacts. To be used
/// between Contacts::make() and the solver, since limits become active according to the poses before the
/// step.
class RowCounter {
 public:
  /// `model` is borrowed.
  RowCounter(const model::Model& model, const std::vector<dJointID>& joints);

  /// Sets rows, islands and max_island_rows. `rest`, `broken_in`: as in model::State; sleeping bodies have no
  /// rows.
  void count(const std::vector<Touch>& touches, std::span<const model::Rest> rest,
             std::span<const std::int32_t> broken_in, stepping::Observables& observables);
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
  std::vector<stepping::IslandCost> islands(const std::vector<Touch>& touches);
  /// The lowest body of the island that contained `body`.
  int island_of(int body) { return sets_.find(body); }

 private:
  /// Rows between two bodies, either of which may be no_body.
  struct Link {
    int body_a, body_b, rows;
  };
  void collect(const std::vector<Touch>& touches, std::span<const model::Rest> rest,
               std::span<const std::int32_t> broken_in);

  const model::Model* model_;
  std::vector<dJointID> joints_;
  std::vector<Link> links_;
  model::DisjointSets sets_;
  std::vector<int> set_rows_;  ///< [num_bodies], at the lowest body of each island
};

}  // namespace pbmpi::ode
