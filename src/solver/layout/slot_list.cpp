#include "solver/layout/slot_list.h"

namespace pbmpi::solver {

void SlotList::add(int slot) { slots_.push_back(slot); }

void SlotSet::start(int num_slots) {
  for (const int slot : added_) seen_[static_cast<std::size_t>(slot)] = 0;
  added_.clear();
  seen_.resize(static_cast<std::size_t>(num_slots), 0);
}

}  // namespace pbmpi::solver
