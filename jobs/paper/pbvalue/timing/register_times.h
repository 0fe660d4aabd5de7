/// When the values of the guest's registers are ready, within the current block.
#pragma once

#include "jobs/paper/pbvalue/timing/op_list.h"

/// The register at this offset of the guest's state; the x87 stack counts as one register.
UInt register_at(Int offset);
UInt x87_register(void);
Bool is_flags(Int offset);
/// Is this part of a vector register above its lowest bytes? A write of the whole register begins at these.
Bool is_upper_part(Int offset);

/// Begins a block: no register is set yet.
void forget_registers(void);
/// Begins an instruction.
void begin_writes(void);

Times of_register(UInt reg);
/// `in_part`: the rest of the register is kept.
void set_register(UInt reg, Times times, Bool in_part);
/// The joined times of the registers that the instruction has set; put_written() sets them all to `slot`.
Times written_times(void);
void put_written(Slot slot);

/// Puts the times of registers into their own slots, where the following code finds them.
void leave_registers(void);
