/// The order in which contacts are solved, and which of them are solved side by side.
#pragma once

#include <span>
#include <vector>

#include "model/contact.h"
#include "model/step_memory.h"
#include "solver/contacts/contact_colors.h"
#include "solver/layout/lane_place.h"

namespace pbmpi::solver {

/// Contact points between the same two bodies, solved one after the other while the bodies' velocities stay
/// in registers.
struct Manifold {
  const model::Contact* points = nullptr;  ///< [num_points]; null: the lane idles
  model::ContactForce* forces = nullptr;   ///< [num_points]; null: nothing is remembered
  short num_points = 0;
  short color = 0;  ///< see ContactColors
  LanePlace a, b;   ///< b: the static slot for the environment
};

/// Collects the manifolds of all worlds of a pack and deals them out to slots of lanes, which are solved one
/// after the other. In each world a body's manifolds are solved by ascending colour (see ContactColors); a
/// manifold may go into any slot after those that its bodies have had, so that the sweep is the same
/// Gauss-Seidel whatever shares its slot, and for every number of lanes.
class ManifoldOrder {
 public:
  static constexpr int most_points = 4;

  void clear();
  /// The manifolds to come are of a world with so many bodies.
  void start_world(int num_bodies);
  /// In canonical order. `points` and `forces` hold until the next clear().
  void add(std::span<const model::Contact> points, model::ContactForce* forces, LanePlace a, LanePlace b);

  /// [slots][num_lanes]; lanes without a manifold idle on `static_slot`, which comes after all other slots of
  /// bodies.
  std::span<const Manifold> deal(int num_lanes, int static_slot);
  /// What the last deal() returned, without the points' memory, which may be gone.
  std::span<const Manifold> dealt() const {
    return std::span(dealt_).first(slots_.size() * static_cast<std::size_t>(num_lanes_));
  }
  int num_slots() const { return static_cast<int>(slots_.size()); }
  /// The most that a manifold of the slot has.
  int num_points(int slot) const { return slots_[static_cast<std::size_t>(slot)].num_points; }

  /// visit(slot) of both bodies of each manifold.
  template <class Visit>
  void for_each_place(Visit visit) const {
    for (std::size_t i = 0; i < painted_.size(); ++i) {
      visit(painted_[i].a.slot);
      visit(painted_[i].b.slot);
    }
  }

 private:
  struct Slot {
    int used = 0;        ///< lanes
    int num_points = 0;  ///< the most of its manifolds
  };

  void sort_by_color();
  int choose_slot(const Manifold& manifold) const;
  void put(const Manifold& manifold, int slot);
  void idle();
  bool is_full(int slot) const { return slots_[static_cast<std::size_t>(slot)].used == num_lanes_; }
  bool moves(LanePlace place) const { return place.slot != static_slot_; }
  std::size_t index_of(LanePlace place) const {
    return static_cast<std::size_t>(place.slot * num_lanes_ + place.lane);
  }

  int num_lanes_ = 1, static_slot_ = 0;  ///< of the pack
  int num_bodies_ = 0;
  bool started_ = false;  ///< have manifolds of the world at hand been coloured?
  ContactColors painter_;
  std::vector<Manifold> painted_;  ///< world by world
  std::vector<int> next_;          ///< [colours x most_points] buckets: by colour, the most points first
  std::vector<int> by_color_;      ///< of painted_
  std::vector<Slot> slots_;
  int first_open_ = 0;      ///< the first slot with room
  std::vector<int> ready_;  ///< [slots of bodies x num_lanes] the first slot that a body may go into next
  std::vector<Manifold> dealt_;  ///< [at least slots][num_lanes]: room is kept from step to step
};

}  // namespace pbmpi::solver
