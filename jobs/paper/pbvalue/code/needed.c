#include "jobs/paper/pbvalue/code/needed.h"

#include <pub_tool_mallocfree.h>
#include "jobs/paper/pbvalue/code/ir_classes.h"

static void need(Bool* needed, const IRExpr* atom) {
  if (atom != NULL && atom->tag == Iex_RdTmp) needed[atom->Iex.RdTmp.tmp] = True;
}

static void need_operands(Bool* needed, const IRExpr* e) {
  switch (e->tag) {
    case Iex_RdTmp:
      need(needed, e);
      break;
    case Iex_Unop:
      need(needed, e->Iex.Unop.arg);
      break;
    case Iex_Binop:
      need(needed, e->Iex.Binop.arg1);
      need(needed, e->Iex.Binop.arg2);
      break;
    case Iex_Triop:
      need(needed, e->Iex.Triop.details->arg2);
      need(needed, e->Iex.Triop.details->arg3);
      break;
    case Iex_Qop:
      need(needed, e->Iex.Qop.details->arg2);
      need(needed, e->Iex.Qop.details->arg3);
      need(needed, e->Iex.Qop.details->arg4);
      break;
    case Iex_ITE:
      need(needed, e->Iex.ITE.cond);
      need(needed, e->Iex.ITE.iftrue);
      need(needed, e->Iex.ITE.iffalse);
      break;
    case Iex_CCall:
      for (IRExpr** argument = e->Iex.CCall.args; *argument != NULL; ++argument) need(needed, *argument);
      break;
    default:
      break;
  }
}

Bool* find_needed(const IRSB* block) {
  Bool* needed = VG_(calloc)("pbvalue.needed", (SizeT)block->tyenv->types_used + 1, sizeof(Bool));
  need(needed, block->next);
  for (Int i = block->stmts_used - 1; i >= 0; --i) {
    const IRStmt* s = block->stmts[i];
    if (s->tag == Ist_Put) need_operands(needed, s->Ist.Put.data);
    if (s->tag == Ist_PutI) need_operands(needed, s->Ist.PutI.details->data);
    if (s->tag == Ist_Store) need_operands(needed, s->Ist.Store.data);
    if (s->tag == Ist_Exit) need(needed, s->Ist.Exit.guard);
    if (s->tag == Ist_CAS) need(needed, s->Ist.CAS.details->dataLo);
    if (s->tag == Ist_Dirty) {
      for (IRExpr** argument = s->Ist.Dirty.details->args; *argument != NULL; ++argument)
        need(needed, *argument);
    }
    if (s->tag == Ist_WrTmp && s->Ist.WrTmp.data->tag != Iex_Load) {
      const IRTemp temp = s->Ist.WrTmp.tmp;
      const OpKind kind = facts_of(s->Ist.WrTmp.data, block->tyenv->types[temp]).kind;
      const Bool passes_through = kind == op_join || kind <= op_int_div;
      if (needed[temp] || !passes_through) need_operands(needed, s->Ist.WrTmp.data);
    }
  }
  return needed;
}
