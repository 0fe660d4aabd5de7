/// When the operands of expressions are ready, within the current block. Its representation is flat: operands
/// are temporaries, constants and registers.
#pragma once

#include <libvex_ir.h>
#include "jobs/paper/pbvalue/timing/op_list.h"

/// Begins a block with `count` temporaries.
void forget_temps(Int count);
void set_temp(IRTemp temp, Times times);
void include_atom(Times* times, const IRExpr* atom);
Times times_of(const IRExpr* e);
