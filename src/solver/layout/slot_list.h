/// Slots of bodies, collected step by step.
#pragma once

#include <span>
#include <vector>

namespace pbmpi::solver {

class SlotList {
 public:
  void clear() { slots_.clear(); }
  void add(int slot);
  std::span<const int> all() const { return {slots_.data(), slots_.size()}; }

 private:
  std::vector<int> slots_;
};

/// A set of slots.
class SlotSet {
 public:
  /// Empties the set; takes a time in proportion to what was in it.
  void start(int num_slots);
  /// False if the slot is in the set already.
  bool add(int slot) {
    if (seen_.data()[slot] != 0) return false;
    seen_.data()[slot] = 1;
    added_.push_back(slot);
    return true;
  }

 private:
  std::vector<char> seen_;
  std::vector<int> added_;
};

}  // namespace pbmpi::solver
