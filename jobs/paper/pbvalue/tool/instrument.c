#include "jobs/paper/pbvalue/tool/instrument.h"

#include <pub_tool_libcassert.h>
#include <pub_tool_machine.h>
#include <pub_tool_mallocfree.h>
#include "jobs/paper/pbvalue/code/decode.h"
#include "jobs/paper/pbvalue/code/ir_classes.h"
#include "jobs/paper/pbvalue/code/needed.h"
#include "jobs/paper/pbvalue/tool/options.h"
#include "jobs/paper/pbvalue/tool/run_time.h"

enum { max_statements_of_instruction = 16 };  // the statement's number is 4 bits of the key, as in the paper

/// State of one block.
typedef struct {
  IRSB* out;
  IRExpr *counting, *predicting;  ///< I1
  Bool* needed;
  Decoded decoded;
  Addr pc;
  UInt num_results;  ///< predictable results of the instruction so far
  Short num_words, num_sites;
} Work;

static IRExpr* word_of(const void* pointer) { return IRExpr_Const(IRConst_U64((ULong)(Addr)pointer)); }
static IRExpr* read_temp(IRTemp temp) { return IRExpr_RdTmp(temp); }

static IRExpr* assign(Work* work, IRType type, IRExpr* value) {
  const IRTemp temp = newIRTemp(work->out->tyenv, type);
  addStmtToIRSB(work->out, IRStmt_WrTmp(temp, value));
  return read_temp(temp);
}

static IRExpr* flag_at(Work* work, ULong* flag) {
  IRExpr* value = assign(work, Ity_I64, IRExpr_Load(Iend_LE, Ity_I64, word_of(flag)));
  return assign(work, Ity_I1, IRExpr_Binop(Iop_CmpNE64, value, IRExpr_Const(IRConst_U64(0))));
}

/// Leaves `value` (I64 or I1) for the cycle models; -1 without them.
static Short leave_word(Work* work, IRExpr* value) {
  if (num_models() == 0) return -1;
  tl_assert(work->num_words < max_words);
  if (typeOfIRExpr(work->out->tyenv, value) == Ity_I1)
    value = assign(work, Ity_I64, IRExpr_Unop(Iop_1Uto64, value));
  addStmtToIRSB(work->out, IRStmt_Store(Iend_LE, word_of(&block_words[work->num_words]), value));
  return work->num_words++;
}

static void call_guarded(Work* work, IRDirty* call, IRExpr* guard) {
  call->guard = guard;
  addStmtToIRSB(work->out, IRStmt_Dirty(call));
}

static void end_segment_here(Work* work) {
  const Segment* segment = end_segment();
  if (segment->num_instructions == 0 && segment->num_ops == 0) return;
  call_guarded(work, unsafeIRDirty_0_N(0, "run_segment", (void*)run_segment, mkIRExprVec_1(word_of(segment))),
               work->counting);
}

static IRExpr* number(Short n) { return IRExpr_Const(IRConst_U64((ULong)n)); }

/// The value (I64) after its prediction.
static IRExpr* predicted_word(Work* work, Site* site, IRExpr* value) {
  const IRTemp temp = newIRTemp(work->out->tyenv, Ity_I64);
  call_guarded(work,
               unsafeIRDirty_1_N(temp, 0, "predict_word", (void*)predict_word,
                                 mkIRExprVec_3(word_of(site), value, number(work->num_sites))),
               work->predicting);
  return assign(work, Ity_I64, IRExpr_ITE(work->predicting, read_temp(temp), value));
}

static IRExpr* predicted_long(Work* work, Site* site, IRExpr* value, IRType type) {
  addStmtToIRSB(work->out, IRStmt_Store(Iend_LE, word_of(&shuttle), value));
  IRDirty* call = unsafeIRDirty_0_N(0, "predict_long", (void*)predict_long,
                                    mkIRExprVec_2(word_of(site), number(work->num_sites)));
  call->mFx = Ifx_Modify;
  call->mAddr = word_of(&shuttle);
  call->mSize = (Int)sizeof shuttle;
  call_guarded(work, call, work->predicting);
  return IRExpr_Load(Iend_LE, type, word_of(&shuttle));
}

/// Predicts values of at most 8 bytes that are a whole result, converted to I64 and back.
static IRExpr* through_word(Work* work, Site* site, IRExpr* value, IRType type, IROp to, IROp from) {
  IRExpr* word = to == Iop_INVALID ? value : assign(work, Ity_I64, IRExpr_Unop(to, value));
  IRExpr* predicted = predicted_word(work, site, word);
  (void)type;
  return from == Iop_INVALID ? predicted : IRExpr_Unop(from, predicted);
}

static IRExpr* predicted_f32(Work* work, Site* site, IRExpr* value) {
  IRExpr* bits = assign(work, Ity_I32, IRExpr_Unop(Iop_ReinterpF32asI32, value));
  IRExpr* result = assign(work, Ity_I32, through_word(work, site, bits, Ity_I32, Iop_32Uto64, Iop_64to32));
  return IRExpr_Unop(Iop_ReinterpI32asF32, result);
}

/// Predicts the lowest lane of a vector register; the others stay.
static IRExpr* predicted_lane(Work* work, Site* site, IRExpr* value) {
  if (site->type.bytes == 8) {
    IRExpr* lane = assign(work, Ity_I64, IRExpr_Unop(Iop_V128to64, value));
    return IRExpr_Binop(Iop_SetV128lo64, value, predicted_word(work, site, lane));
  }
  IRExpr* lane = assign(work, Ity_I32, IRExpr_Unop(Iop_V128to32, value));
  IRExpr* result = assign(work, Ity_I32, through_word(work, site, lane, Ity_I32, Iop_32Uto64, Iop_64to32));
  return IRExpr_Binop(Iop_SetV128lo32, value, result);
}

static IRExpr* predicted(Work* work, Site* site, IRExpr* value, IRType type, Bool is_scalar) {
  if (is_scalar) return predicted_lane(work, site, value);
  switch (type) {
    case Ity_I8:
      return through_word(work, site, value, type, Iop_8Uto64, Iop_64to8);
    case Ity_I16:
      return through_word(work, site, value, type, Iop_16Uto64, Iop_64to16);
    case Ity_I32:
      return through_word(work, site, value, type, Iop_32Uto64, Iop_64to32);
    case Ity_I64:
      return through_word(work, site, value, type, Iop_INVALID, Iop_INVALID);
    case Ity_F64:
      return through_word(work, site, value, type, Iop_ReinterpF64asI64, Iop_ReinterpI64asF64);
    case Ity_F32:
      return predicted_f32(work, site, value);
    default:
      return predicted_long(work, site, value, type);
  }
}

typedef struct {
  Bool can_be, is_scalar;
  ValueClass value_class;
  ValueType type;
} Candidate;

static Bool has_a_size(IRType type) {
  switch (type) {
    case Ity_I8:
    case Ity_I16:
    case Ity_I32:
    case Ity_I64:
    case Ity_F32:
    case Ity_F64:
    case Ity_V128:
    case Ity_V256:
      return True;
    default:
      return False;
  }
}

static Candidate loaded(const Work* work, IRType type) {
  Candidate result = {.can_be = True, .value_class = work->decoded.is_float ? class_fp_load : class_int_load};
  const UChar bytes = (UChar)sizeofIRType(type);
  const UChar lane = type == Ity_F64          ? 8
                     : type == Ity_F32        ? 4
                     : work->decoded.is_float ? work->decoded.lane_bytes
                                              : 0;
  result.type.bytes = bytes;
  if (lane != 0 && lane <= bytes) {
    result.type.lane_bytes = lane;
    result.type.num_lanes = bytes / lane;
  }
  return result;
}

static Candidate candidate(const Work* work, const IRStmt* s) {
  Candidate none = {0};
  const IRExpr* e = s->Ist.WrTmp.data;
  const IRType type = work->out->tyenv->types[s->Ist.WrTmp.tmp];
  if (!has_a_size(type)) return none;
  if (e->tag == Iex_Load) return loaded(work, type);
  const OpFacts facts = facts_of(e, type);
  if (facts.is_float) {
    const Candidate result = {
        .can_be = True, .is_scalar = facts.is_scalar, .value_class = class_fp_operation, .type = facts.type};
    return result;
  }
  if (facts.kind > op_int_div || !work->needed[s->Ist.WrTmp.tmp] || (type != Ity_I32 && type != Ity_I64))
    return none;
  const Candidate result = {
      .can_be = True, .value_class = class_int_operation, .type = {.bytes = (UChar)sizeofIRType(type)}};
  return result;
}

static Bool is_wanted(ValueClass value_class) {
  return (options.predict & (value_class <= class_fp_operation ? predict_fp : predict_int)) != 0;
}

/// Adds a WrTmp; returns the index of its outcome among those of the block, or -1 if it is not predicted.
static Short add_result(Work* work, IRStmt* s) {
  const Candidate found = candidate(work, s);
  const UInt id = found.can_be ? work->num_results++ : max_statements_of_instruction;
  if (!found.can_be || id >= max_statements_of_instruction || !is_wanted(found.value_class) ||
      work->num_sites >= max_words) {
    addStmtToIRSB(work->out, s);
    return -1;
  }
  const IRType type = work->out->tyenv->types[s->Ist.WrTmp.tmp];
  Site* site = find_site(work->pc, id, found.value_class, found.type);
  IRExpr* computed = assign(work, type, s->Ist.WrTmp.data);
  IRExpr* result = predicted(work, site, computed, type, found.is_scalar);
  addStmtToIRSB(work->out, IRStmt_WrTmp(s->Ist.WrTmp.tmp, result));
  return work->num_sites++;
}

static void add_exit_statement(Work* work, IRStmt* s) {
  const Bool is_branch =
      s->Ist.Exit.jk == Ijk_Boring || s->Ist.Exit.jk == Ijk_Call || s->Ist.Exit.jk == Ijk_Ret;
  if (is_branch) {
    const Short word = leave_word(work, s->Ist.Exit.guard);
    if (num_models() > 0) add_exit(s->Ist.Exit.guard, (Addr)s->Ist.Exit.dst->Ico.U64, word);
    end_segment_here(work);
  }
  addStmtToIRSB(work->out, s);
}

static void add_instruction_mark(Work* work, IRStmt* s) {
  work->pc = s->Ist.IMark.addr;
  work->decoded = decode((const UChar*)s->Ist.IMark.addr, s->Ist.IMark.len);
  work->num_results = 0;
  begin_instruction(work->pc, s->Ist.IMark.len, &work->decoded);
  addStmtToIRSB(work->out, s);
}

static void add(Work* work, IRStmt* s) {
  Short word = -1, site = -1;
  switch (s->tag) {
    case Ist_IMark:
      add_instruction_mark(work, s);
      return;
    case Ist_Exit:
      add_exit_statement(work, s);
      return;
    case Ist_NoOp:
    case Ist_AbiHint:
    case Ist_MBE:
      addStmtToIRSB(work->out, s);
      return;
    case Ist_WrTmp:
      if (s->Ist.WrTmp.data->tag == Iex_Load) word = leave_word(work, s->Ist.WrTmp.data->Iex.Load.addr);
      site = add_result(work, s);
      break;
    case Ist_Store:
      word = leave_word(work, s->Ist.Store.addr);
      addStmtToIRSB(work->out, s);
      break;
    default:
      addStmtToIRSB(work->out, s);
      break;
  }
  if (num_models() > 0) add_statement(s, word, site);
}

IRSB* instrument(VgCallbackClosure* closure, IRSB* in, const VexGuestLayout* layout,
                 const VexGuestExtents* extents, const VexArchInfo* host, IRType guest_word,
                 IRType host_word) {
  (void)closure, (void)layout, (void)extents, (void)host, (void)guest_word, (void)host_word;
  Work work = {.out = deepCopyIRSBExceptStmts(in), .needed = find_needed(in)};
  begin_block(in, work.needed);
  Int i = 0;
  for (; i < in->stmts_used && in->stmts[i]->tag != Ist_IMark; ++i) addStmtToIRSB(work.out, in->stmts[i]);
  work.counting = flag_at(&work, &counting);
  work.predicting = flag_at(&work, &predicting);
  for (; i < in->stmts_used; ++i) add(&work, in->stmts[i]);
  const Bool is_branch = in->jumpkind == Ijk_Boring || in->jumpkind == Ijk_Call || in->jumpkind == Ijk_Ret;
  if (num_models() > 0 && is_branch) add_end(in->next, in->jumpkind, leave_word(&work, in->next));
  end_segment_here(&work);
  VG_(free)(work.needed);
  return work.out;
}
