/// When the operands of expressions are there, within the block at hand. Its representation is flat: operands
/// are temporaries, constants and registers.
#pragma once

#include <libvex_ir.h>
#include "prediction/timing/op_list.h"

/// A new block with so many temporaries.
void forget_temps(Int count);
void set_temp(IRTemp temp, Times times);
void include_atom(Times* times, const IRExpr* atom);
Times times_of(const IRExpr* e);
