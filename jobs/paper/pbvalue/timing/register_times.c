#include "jobs/paper/pbvalue/timing/register_times.h"

#include <pub_tool_libcbase.h>

enum { ymm_bytes = 32, stack_register = 60, first_vector_offset = 224 };

static struct {
  Times times[num_registers];  ///< where `is_set`; otherwise the register's own slot
  Bool is_set[num_registers];
  UChar set_here[num_registers];  ///< by the instruction
} r;

UInt register_at(Int offset) {
  if (offset < first_vector_offset) return (UInt)offset / 8;
  const UInt ymm = 32 + ((UInt)offset - first_vector_offset) / ymm_bytes;
  return ymm < stack_register ? ymm : stack_register;
}

UInt x87_register(void) { return stack_register; }

/// The flags, which are computed from operands later on in Valgrind's representation, but with the result in
/// a processor.
Bool is_flags(Int offset) { return offset >= 144 && offset < 176; }

Bool is_upper_part(Int offset) {
  return offset >= first_vector_offset && (offset - first_vector_offset) % ymm_bytes != 0;
}

void forget_registers(void) { VG_(memset)(r.is_set, 0, sizeof r.is_set); }
void begin_writes(void) { VG_(memset)(r.set_here, 0, sizeof r.set_here); }

Times of_register(UInt reg) { return r.is_set[reg] ? r.times[reg] : of_slot((Slot)reg); }

void set_register(UInt reg, Times times, Bool in_part) {
  if (in_part) {
    const Times before = of_register(reg);
    include_all(&times, &before);
  }
  r.times[reg] = times;
  r.is_set[reg] = True;
  r.set_here[reg] = 1;
}

Times written_times(void) {
  Times times = {0};
  for (UInt reg = 0; reg < num_registers; ++reg) {
    if (r.set_here[reg]) include_all(&times, &r.times[reg]);
  }
  return times;
}

void put_written(Slot slot) {
  for (UInt reg = 0; reg < num_registers; ++reg) {
    if (r.set_here[reg]) r.times[reg] = of_slot(slot);
  }
}

/// Where a block exchanges registers, the join of one would overwrite a time that another still waits for:
/// those times first move into slots of their own.
static void free_from_registers(void) {
  for (UInt reg = 0; reg < num_registers; ++reg) {
    if (!r.is_set[reg]) continue;
    Times* times = &r.times[reg];
    for (Int i = 0; i < times->count; ++i) {
      const Slot slot = times->slots[i];
      if (slot < num_registers && slot != reg && r.is_set[slot]) {
        join(times);
        break;
      }
    }
  }
}

void leave_registers(void) {
  free_from_registers();
  for (UInt reg = 0; reg < num_registers; ++reg) {
    if (!r.is_set[reg]) continue;
    const Times* times = &r.times[reg];
    if (times->count != 1 || times->slots[0] != reg) {
      MicroOp* op = new_op(op_join);
      set_sources(op, times);
      op->dest = (Slot)reg;
    }
    r.times[reg] = of_slot((Slot)reg);
  }
}
