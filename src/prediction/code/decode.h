/// What an x86-64 instruction is: which classes of the paper's section 3.3 it counts as, and of which type
/// the numbers are that it loads.
#pragma once

#include <pub_tool_basics.h>

/// Classes of instructions. One counts as what it computes, its access to memory counts besides as a load or
/// a store; a plain move is only its load or store, and between registers it is an integer or a
/// floating-point operation. What works on SSE, AVX or x87 registers is floating point.
typedef enum { mix_floating_point, mix_integer, mix_branch, mix_store, mix_load, num_mix_classes } MixClass;
extern const HChar* const mix_names[num_mix_classes];

typedef enum {
  no_branch,
  branch_conditional,
  branch_direct,
  branch_indirect,
  branch_call,
  branch_return
} BranchKind;

typedef struct {
  UChar mix;         ///< bit i: counts as MixClass i
  UChar branch;      ///< BranchKind; of an indirect call, branch_indirect
  UChar lane_bytes;  ///< of what a floating-point instruction loads: 4, 8, or 0 if the opcode does not say
  Bool is_float;     ///< works on SSE, AVX or x87 registers
} Decoded;

/// `bytes`: the `length` bytes of one whole instruction.
Decoded decode(const UChar* bytes, UInt length);
