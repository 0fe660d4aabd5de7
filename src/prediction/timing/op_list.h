/// The micro-operations of the block at hand, and the times at which their operands are there.
#pragma once

#include "prediction/timing/core_model.h"

enum { max_ops = 2048, num_registers = 128 };

/// When a value is there: at the latest of these times.
typedef struct {
  UChar count;
  Slot slots[max_sources];
} Times;

typedef struct {
  MicroOp ops[max_ops];
  UInt num_ops;
  Slot next_slot;  ///< the first ones are those of the registers
  Addr fetch;      ///< of the next operation: where its instruction is the first in its line; else 0
  Bool has_op;     ///< the instruction has an operation already
} OpList;
extern OpList op_list;

MicroOp* new_op(OpKind kind);
Slot new_slot(void);
void set_sources(MicroOp* op, const Times* times);

/// More than an operation can wait for becomes one time.
void join(Times* times);
void include(Times* times, Slot slot);
void include_all(Times* times, const Times* others);
Times of_slot(Slot slot);
