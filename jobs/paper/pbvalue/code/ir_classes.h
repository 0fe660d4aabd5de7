/// Classifies the operations of Valgrind's intermediate representation.
#pragma once

#include <pub_tool_basics.h>
#include <pub_tool_tooliface.h>
#include "jobs/paper/pbvalue/code/values.h"

/// Kinds of micro-operations, by the unit that executes them and by latency.
typedef enum {
  op_int,
  op_int_mul,
  op_int_div,
  op_fp_add,
  op_fp_mul,
  op_fp_div,
  op_fp_sqrt,
  op_fp_other,  ///< conversions, comparisons, logic and shuffles of vector registers
  op_load,
  op_store,
  op_branch,
  op_join,  ///< no operation: its result is ready when all its sources are
  num_op_kinds
} OpKind;

typedef struct {
  OpKind kind;     ///< op_join: only moves or renames bits
  Bool is_float;   ///< the result comes from floating-point arithmetic, of this type
  Bool is_scalar;  ///< the result is in the lowest lane of a vector register; the other lanes pass through
  ValueType type;
} OpFacts;

OpFacts facts_of(const IRExpr* expression, IRType result);
