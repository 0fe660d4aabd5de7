/// Which contacts are solved side by side.
#pragma once

#include <span>
#include <vector>

#include "model/contact.h"
#include "model/step_memory.h"
#include "solver/layout/lane_place.h"

namespace pbmpi::solver {

/// Contact points between the same two bodies, solved while the bodies' velocities stay in registers.
struct Manifold {
  const model::Contact* points = nullptr;  ///< [num_points]; null: the lane is idle
  model::ContactForce* forces = nullptr;   ///< [num_points]; null: nothing is remembered
  short num_points = 0;
  short color = 0;  ///< see ContactColors
  LanePlace a, b;   ///< b: the static slot if it is the environment
};

/// Collects the manifolds of one kind, of all worlds of a pack, and deals them out to slots of lanes. A slot
/// holds manifolds of one colour, of which no two touch the same body, so that a sweep may take the colours
/// in any order, and is the same Gauss-Seidel whichever manifolds share a slot, and for every number of
/// lanes.
class ManifoldOrder {
 public:
  static constexpr int most_points = 4;

  /// [first, end)
  struct SlotRange {
    int first = 0, end = 0;
  };

  void clear();
  /// Its points must stay valid until the next clear().
  void add(const Manifold& manifold);

  /// [slots][num_lanes], by ascending colour, and within a colour by descending number of points, since a
  /// slot takes as long as its longest manifold. Lanes without a manifold idle on `static_slot`, which comes
  /// after all other slots of bodies.
  std::span<const Manifold> deal(int num_lanes, int static_slot);
  /// What the last deal() returned; the memory of the points may be gone.
  std::span<const Manifold> dealt() const {
    return std::span(dealt_).first(num_points_.size() * static_cast<std::size_t>(num_lanes_));
  }
  int num_slots() const { return static_cast<int>(num_points_.size()); }
  /// The most points that a manifold of the slot has.
  int num_points(int slot) const { return num_points_[static_cast<std::size_t>(slot)]; }
  /// Empty for a colour that no manifold has.
  SlotRange slots_of(int color) const {
    const auto at = static_cast<std::size_t>(color);
    return at + 1 < first_slot_.size() ? SlotRange{first_slot_[at], first_slot_[at + 1]} : SlotRange{};
  }

  /// Calls visit(slot) for both bodies of each manifold.
  template <class Visit>
  void for_each_place(Visit visit) const {
    for (std::size_t i = 0; i < painted_.size(); ++i) {
      visit(painted_[i].a.slot);
      visit(painted_[i].b.slot);
    }
  }

 private:
  void sort_by_color();
  void put(const Manifold& manifold);
  void fill_last_slot();

  int num_lanes_ = 1, static_slot_ = 0;  ///< of the pack
  std::vector<Manifold> painted_;        ///< as added
  std::vector<int> next_;                ///< [colours x most_points] buckets: by colour, most points first
  std::vector<int> by_color_;            ///< indices into painted_
  std::vector<int> first_slot_;          ///< [colours + 1]
  std::vector<int> num_points_;          ///< [slots]
  int used_ = 0;                         ///< lanes of the last slot
  std::vector<Manifold> dealt_;          ///< [at least slots][num_lanes]; memory is kept from step to step
};

}  // namespace pbmpi::solver
