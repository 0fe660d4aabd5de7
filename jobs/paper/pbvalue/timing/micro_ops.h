/// Splits the code of a block into micro-operations, with the values that each waits for. An instruction has
/// one for each load, store and floating-point operation, and one for its integer arithmetic, flags and
/// branch; an instruction that only moves registers has one. Address arithmetic is part of the access, as in
/// a processor's addressing modes.
#pragma once

#include "jobs/paper/pbvalue/code/decode.h"
#include "jobs/paper/pbvalue/timing/core_model.h"

/// The code between two exits of a block, executed as a whole.
typedef struct {
  UInt num_instructions, num_ops;
  UInt mix[num_mix_classes];
  MicroOp* ops;  ///< null without cycle models
} Segment;

/// Begins a block. `needed` [temporaries]: the value is used for more than the address of an access.
void begin_block(const IRSB* block, const Bool* needed);
void begin_instruction(Addr pc, UInt length, const Decoded* decoded);
/// Adds one statement of the instruction; `word` and `site` as in MicroOp.
void add_statement(const IRStmt* statement, Short word, Short site);
/// Notes that the instruction may leave the block here, if word `word` is set.
void add_exit(const IRExpr* guard, Addr to, Short word);
/// Adds the end of the block; `word` holds the target of an indirect branch.
void add_end(const IRExpr* next, IRJumpKind kind, Short word);
/// Returns what was added since the last segment.
Segment* end_segment(void);
