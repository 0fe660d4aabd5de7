/// When the values of the guest's registers are there, within the block at hand.
#pragma once

#include "prediction/timing/op_list.h"

/// The register at this offset of the guest's state; those of the x87 stack are one.
UInt register_at(Int offset);
UInt x87_register(void);
Bool is_flags(Int offset);
/// Of a vector register: not its lowest bytes, from which on it is written as a whole.
Bool is_upper_part(Int offset);

/// No register is set yet: a new block.
void forget_registers(void);
/// A new instruction.
void begin_writes(void);

Times of_register(UInt reg);
/// `in_part`: the rest of the register stays.
void set_register(UInt reg, Times times, Bool in_part);
/// The registers that the instruction has set: their times together; sets them all to `slot`.
Times written_times(void);
void put_written(Slot slot);

/// Leaves the times of registers in their own slots, where what follows finds them.
void leave_registers(void);
