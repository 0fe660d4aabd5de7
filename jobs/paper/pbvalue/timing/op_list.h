/// The micro-operations of the current block, and the times at which their operands are ready.
#pragma once

#include "jobs/paper/pbvalue/timing/core_model.h"

enum { max_ops = 2048, num_registers = 128 };

/// When a value is ready: at the latest of these times.
typedef struct {
  UChar count;
  Slot slots[max_sources];
} Times;

typedef struct {
  MicroOp ops[max_ops];
  UInt num_ops;
  Slot next_slot;  ///< the first slots are the registers'
  Addr fetch;      ///< for the next operation: its instruction's address where that is the first in its line;
                   ///< otherwise 0
  Bool has_op;     ///< the instruction has an operation already
} OpList;
extern OpList op_list;

MicroOp* new_op(OpKind kind);
Slot new_slot(void);
void set_sources(MicroOp* op, const Times* times);

/// Reduces more times than an operation can wait for to one.
void join(Times* times);
void include(Times* times, Slot slot);
void include_all(Times* times, const Times* others);
Times of_slot(Slot slot);
