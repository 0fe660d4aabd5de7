#include "solver/layout/slot_list.h"

namespace pbmpi::solver {

void SlotList::add(int slot) { slots_.push_back(slot); }

void SlotSet::start(int num_slots) { seen_.assign(static_cast<std::size_t>(num_slots), 0); }

}  // namespace pbmpi::solver
