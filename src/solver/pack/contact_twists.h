/// Moves velocities of bodies in contact between their slots, where joints change them, and rows, where
/// contacts do (twist_rows.h).
#pragma once

#include "solver/layout/slot_list.h"
#include "solver/pack/world_lanes.h"

namespace pbmpi::solver {

/// The velocities of bodies without joints stay in the rows throughout the solve; those of jointed bodies are
/// copied when the other side needs them.
template <class T>
class ContactTwists {
 public:
  /// At the beginning of a step. for_each_body_slot(visit) visits the slots in contact, some more than once.
  template <class ForEachBodySlot>
  void find(const WorldLanes<T>& worlds, ForEachBodySlot for_each_body_slot) {
    jointed_.clear();
    free_.clear();
    seen_.start(worlds.bodies.static_slot + 1);
    for_each_body_slot([&](int slot) {
      if (slot == worlds.bodies.static_slot || !seen_.add(slot)) return;
      (worlds.places.has_joints(slot) ? jointed_ : free_).add(slot);
    });
  }

  /// All twists are in the slots, before and after a solve.
  void start(BodyLanes<T>& bodies) {
    write(free_, bodies);
    where_ = Where::slots;
  }
  /// After need_slots().
  void end(BodyLanes<T>& bodies) { read(free_, bodies); }
  /// need_rows() before contacts change the rows, changed_rows() after.
  void need_rows(BodyLanes<T>& bodies) {
    if (where_ != Where::slots) return;
    write(jointed_, bodies);
    where_ = Where::both;
  }
  void changed_rows() { where_ = Where::rows; }
  /// need_slots() before joints change the slots of jointed bodies, changed_slots() after.
  bool are_in_rows() const { return where_ == Where::rows; }
  void need_slots(BodyLanes<T>& bodies) {
    if (where_ != Where::rows) return;
    read(jointed_, bodies);
    where_ = Where::both;
  }
  void changed_slots() { where_ = Where::slots; }

 private:
  /// Where the twists of jointed bodies are up to date.
  enum class Where { slots, rows, both };

  static void write(const SlotList& slots, BodyLanes<T>& bodies) {
    for (const int slot : slots.all()) bodies.contact_twists.set_slot(slot, bodies.twists[slot]);
  }
  static void read(const SlotList& slots, BodyLanes<T>& bodies) {
    for (const int slot : slots.all()) bodies.twists[slot] = bodies.contact_twists.slot(slot);
  }

  SlotList jointed_, free_;
  SlotSet seen_;
  Where where_ = Where::slots;
};

}  // namespace pbmpi::solver
