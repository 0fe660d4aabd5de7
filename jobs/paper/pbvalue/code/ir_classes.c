#include "jobs/paper/pbvalue/code/ir_classes.h"

static OpFacts computes(OpKind kind, UChar lane_bytes, UChar num_lanes) {
  const OpFacts facts = {
      .kind = kind,
      .is_float = True,
      .is_scalar = False,
      .type = {.bytes = (UChar)(lane_bytes * num_lanes), .lane_bytes = lane_bytes, .num_lanes = num_lanes}};
  return facts;
}

static OpFacts in_lowest_lane(OpKind kind, UChar lane_bytes) {
  OpFacts facts = computes(kind, lane_bytes, 1);
  facts.is_scalar = True;
  return facts;
}

static OpFacts plain(OpKind kind) {
  const OpFacts facts = {.kind = kind};
  return facts;
}

/// Arithmetic in vector registers and on x87; kind op_join if it is something else.
static OpFacts float_facts(IROp op) {
  switch (op) {
    case Iop_Add64F0x2:
    case Iop_Sub64F0x2:
    case Iop_Min64F0x2:
    case Iop_Max64F0x2:
      return in_lowest_lane(op_fp_add, 8);
    case Iop_Mul64F0x2:
      return in_lowest_lane(op_fp_mul, 8);
    case Iop_Div64F0x2:
      return in_lowest_lane(op_fp_div, 8);
    case Iop_Sqrt64F0x2:
      return in_lowest_lane(op_fp_sqrt, 8);
    case Iop_Add32F0x4:
    case Iop_Sub32F0x4:
    case Iop_Min32F0x4:
    case Iop_Max32F0x4:
      return in_lowest_lane(op_fp_add, 4);
    case Iop_Mul32F0x4:
      return in_lowest_lane(op_fp_mul, 4);
    case Iop_Div32F0x4:
      return in_lowest_lane(op_fp_div, 4);
    case Iop_Sqrt32F0x4:
      return in_lowest_lane(op_fp_sqrt, 4);
    case Iop_Add64Fx2:
    case Iop_Sub64Fx2:
    case Iop_Min64Fx2:
    case Iop_Max64Fx2:
      return computes(op_fp_add, 8, 2);
    case Iop_Mul64Fx2:
      return computes(op_fp_mul, 8, 2);
    case Iop_Div64Fx2:
      return computes(op_fp_div, 8, 2);
    case Iop_Sqrt64Fx2:
      return computes(op_fp_sqrt, 8, 2);
    case Iop_Add32Fx4:
    case Iop_Sub32Fx4:
    case Iop_Min32Fx4:
    case Iop_Max32Fx4:
      return computes(op_fp_add, 4, 4);
    case Iop_Mul32Fx4:
      return computes(op_fp_mul, 4, 4);
    case Iop_Div32Fx4:
      return computes(op_fp_div, 4, 4);
    case Iop_Sqrt32Fx4:
      return computes(op_fp_sqrt, 4, 4);
    case Iop_Add64Fx4:
    case Iop_Sub64Fx4:
    case Iop_Min64Fx4:
    case Iop_Max64Fx4:
      return computes(op_fp_add, 8, 4);
    case Iop_Mul64Fx4:
      return computes(op_fp_mul, 8, 4);
    case Iop_Div64Fx4:
      return computes(op_fp_div, 8, 4);
    case Iop_Sqrt64Fx4:
      return computes(op_fp_sqrt, 8, 4);
    case Iop_Add32Fx8:
    case Iop_Sub32Fx8:
    case Iop_Min32Fx8:
    case Iop_Max32Fx8:
      return computes(op_fp_add, 4, 8);
    case Iop_Mul32Fx8:
      return computes(op_fp_mul, 4, 8);
    case Iop_Div32Fx8:
      return computes(op_fp_div, 4, 8);
    case Iop_Sqrt32Fx8:
      return computes(op_fp_sqrt, 4, 8);
    case Iop_AddF64:
    case Iop_SubF64:
    case Iop_RoundF64toInt:
      return computes(op_fp_add, 8, 1);
    case Iop_MulF64:
    case Iop_MAddF64:
    case Iop_MSubF64:
      return computes(op_fp_mul, 8, 1);
    case Iop_DivF64:
      return computes(op_fp_div, 8, 1);
    case Iop_SqrtF64:
    case Iop_SinF64:
    case Iop_CosF64:
    case Iop_TanF64:
    case Iop_AtanF64:
    case Iop_2xm1F64:
    case Iop_Yl2xF64:
    case Iop_Yl2xp1F64:
    case Iop_ScaleF64:
    case Iop_PRemF64:
    case Iop_PRem1F64:
      return computes(op_fp_sqrt, 8, 1);
    case Iop_I32StoF64:
    case Iop_I64StoF64:
    case Iop_F32toF64:
      return computes(op_fp_other, 8, 1);
    case Iop_AddF32:
    case Iop_SubF32:
      return computes(op_fp_add, 4, 1);
    case Iop_MulF32:
    case Iop_MAddF32:
    case Iop_MSubF32:
      return computes(op_fp_mul, 4, 1);
    case Iop_DivF32:
      return computes(op_fp_div, 4, 1);
    case Iop_SqrtF32:
      return computes(op_fp_sqrt, 4, 1);
    case Iop_F64toF32:
    case Iop_I32StoF32:
    case Iop_I64StoF32:
    case Iop_RoundF32toInt:
      return computes(op_fp_other, 4, 1);
    default:
      return plain(op_join);
  }
}

static Bool is_vector_type(IRType type) {
  return type == Ity_V128 || type == Ity_V256 || type == Ity_F64 || type == Ity_F32;
}

/// Combines two operands into a wider register, or replaces one lane.
static Bool only_moves_pair(IROp op) {
  switch (op) {
    case Iop_64HLtoV128:
    case Iop_V128HLtoV256:
    case Iop_32HLto64:
    case Iop_64HLto128:
    case Iop_16HLto32:
    case Iop_8HLto16:
    case Iop_SetV128lo32:
    case Iop_SetV128lo64:
      return True;
    default:
      return False;
  }
}

static OpFacts unary_facts(IROp op, IRType result) {
  const OpFacts facts = float_facts(op);
  if (facts.kind != op_join) return facts;
  switch (op) {
    case Iop_Not8:
    case Iop_Not16:
    case Iop_Not32:
    case Iop_Not64:
    case Iop_Clz32:
    case Iop_Clz64:
    case Iop_Ctz32:
    case Iop_Ctz64:
      return plain(op_int);
    case Iop_NotV128:
    case Iop_NotV256:
    case Iop_AbsF64:
    case Iop_NegF64:
    case Iop_AbsF32:
    case Iop_NegF32:
      return plain(op_fp_other);
    default:
      (void)result;
      return plain(op_join);
  }
}

static OpFacts binary_facts(IROp op, IRType result) {
  const OpFacts facts = float_facts(op);
  if (facts.kind != op_join) return facts;
  if (only_moves_pair(op)) return plain(op_join);
  switch (op) {
    case Iop_Mul8:
    case Iop_Mul16:
    case Iop_Mul32:
    case Iop_Mul64:
    case Iop_MullS32:
    case Iop_MullU32:
    case Iop_MullS64:
    case Iop_MullU64:
    case Iop_MullS16:
    case Iop_MullU16:
    case Iop_MullS8:
    case Iop_MullU8:
      return plain(op_int_mul);
    case Iop_DivModU64to32:
    case Iop_DivModS64to32:
    case Iop_DivModU128to64:
    case Iop_DivModS128to64:
      return plain(op_int_div);
    case Iop_CmpF64:
    case Iop_CmpF32:
    case Iop_F64toI32S:
    case Iop_F64toI64S:
    case Iop_F32toI32S:
    case Iop_F32toI64S:
    case Iop_F64toI32U:
    case Iop_F64toI64U:
      return plain(op_fp_other);
    default:
      return plain(is_vector_type(result) ? op_fp_other : op_int);
  }
}

OpFacts facts_of(const IRExpr* expression, IRType result) {
  switch (expression->tag) {
    case Iex_Unop:
      return unary_facts(expression->Iex.Unop.op, result);
    case Iex_Binop:
      return binary_facts(expression->Iex.Binop.op, result);
    case Iex_Triop:
    case Iex_Qop: {
      const OpFacts facts = float_facts(expression->tag == Iex_Triop ? expression->Iex.Triop.details->op
                                                                     : expression->Iex.Qop.details->op);
      return facts.kind != op_join ? facts : plain(op_fp_other);
    }
    case Iex_ITE:
    case Iex_CCall:
      return plain(is_vector_type(result) ? op_fp_other : op_int);
    default:
      return plain(op_join);
  }
}
