/// Counts the cycles of the processor of the paper's Table 3: a dataflow model with limited resources. A
/// micro-operation enters the window in program order, at most `width` a cycle; issues when its operands are
/// ready and a unit of its cluster is free; leaves in order. A confident right prediction makes its value
/// available when it enters, a wrong one makes its dependents execute again.
#pragma once

#include <pub_tool_basics.h>
#include "jobs/paper/pbvalue/code/ir_classes.h"
#include "jobs/paper/pbvalue/code/values.h"
#include "jobs/paper/pbvalue/timing/memory_model.h"

enum { max_sources = 6, max_slots = 4096, max_models = 32 };

/// A place that holds the time at which a value is ready: registers of the guest first, then results of the
/// block.
typedef UShort Slot;

/// Static part of a micro-operation. `site`: index of its prediction among the outcomes of the block, or -1;
/// `word`: index of its address or condition among the words that the block leaves, or -1.
typedef struct {
  UChar kind;  ///< OpKind
  UChar num_sources;
  UChar branch;   ///< BranchKind, for op_branch
  Bool taken_if;  ///< for a conditional branch: the condition with which it is taken
  Slot dest;      ///< no_slot: no result
  Slot source[max_sources];
  Short site, word;
  Addr fetch;   ///< the instruction's address where it is the first in its line; otherwise 0
  Addr pc;      ///< for op_branch
  Addr target;  ///< for a direct branch
} MicroOp;
enum { no_slot = 0xFFFF };

/// Dynamic part, the same for all models.
typedef struct {
  UChar level;        ///< Level of its data access
  UChar fetch_level;  ///< Level of its instruction fetch
  Bool mispredicted;  ///< its branch was guessed wrong
  UChar outcome;      ///< Outcome of its prediction
  Addr address;       ///< of its data access
} Event;

/// Adds a model given as "NAME:key=value,key=value". Ends the program with a message for invalid text.
void add_model(const HChar* text);
void print_model_usage(void);
Int num_models(void);
const HChar* model_name(Int model);
const HChar* model_text(Int model);  ///< the text after the name
/// Cycles until everything shown to the model is done.
ULong model_cycles(Int model);

void model_step(const MicroOp* op, const Event* event);
