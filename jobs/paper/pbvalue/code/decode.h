/// Decodes an x86-64 instruction: the classes of the paper's section 3.3 that it counts as, and the type of
/// the numbers that it loads.
#pragma once

#include <pub_tool_basics.h>

/// Classes of instructions. An instruction counts as what it computes, and its access to memory also counts
/// as a load or a store; a plain move is only its load or store, and between registers it is an integer or a
/// floating-point operation. Instructions on SSE, AVX or x87 registers are floating point.
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
  UChar branch;      ///< BranchKind; branch_indirect for an indirect call
  UChar lane_bytes;  ///< lanes of a floating-point load: 4, 8, or 0 if the opcode does not say
  Bool is_float;     ///< works on SSE, AVX or x87 registers
} Decoded;

/// `bytes`: the `length` bytes of one whole instruction.
Decoded decode(const UChar* bytes, UInt length);
