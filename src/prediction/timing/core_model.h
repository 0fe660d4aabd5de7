/// How many cycles the processor of the paper's Table 3 takes: a dataflow model with limited resources. A
/// micro-operation enters the window in program order, at most `width` a cycle; issues when its operands are
/// there and a unit of its cluster is free; leaves in order. A confident right prediction makes its value
/// available when it enters, a wrong one makes its dependents execute again.
#pragma once

#include <pub_tool_basics.h>
#include "prediction/code/ir_classes.h"
#include "prediction/code/values.h"
#include "prediction/timing/memory_model.h"

enum { max_sources = 6, max_slots = 4096, max_models = 32 };

/// A place that holds the time at which a value is there: registers of the guest first, then results of the
/// block.
typedef UShort Slot;

/// Static part of a micro-operation. `site`: its prediction's place among the outcomes of the block, or -1;
/// `word`: its address or condition's place among the words that the block leaves, or -1.
typedef struct {
  UChar kind;  ///< OpKind
  UChar num_sources;
  UChar branch;   ///< BranchKind, of op_branch
  Bool taken_if;  ///< of a conditional branch: the condition with which it is taken
  Slot dest;      ///< no_slot: no result
  Slot source[max_sources];
  Short site, word;
  Addr fetch;   ///< the instruction's address where it is the first in its line; else 0
  Addr pc;      ///< of op_branch
  Addr target;  ///< of a direct branch
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

/// "NAME:key=value,key=value": a model, as in the usage. Ends the program with a message if it is none.
void add_model(const HChar* text);
void print_model_usage(void);
Int num_models(void);
const HChar* model_name(Int model);
const HChar* model_text(Int model);  ///< what follows the name
/// Cycles until all that has been shown to the model is done.
ULong model_cycles(Int model);

void model_step(const MicroOp* op, const Event* event);
