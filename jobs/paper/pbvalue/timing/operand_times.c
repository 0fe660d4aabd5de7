#include "jobs/paper/pbvalue/timing/operand_times.h"

#include <pub_tool_basics.h>
#include <pub_tool_mallocfree.h>
#include "jobs/paper/pbvalue/timing/register_times.h"

static Times* temps;

void forget_temps(Int count) {
  if (temps != NULL) VG_(free)(temps);
  temps = VG_(calloc)("pbvalue.times", (SizeT)count + 1, sizeof(Times));
}

void set_temp(IRTemp temp, Times times) { temps[temp] = times; }

void include_atom(Times* times, const IRExpr* atom) {
  if (atom != NULL && atom->tag == Iex_RdTmp) include_all(times, &temps[atom->Iex.RdTmp.tmp]);
}

Times times_of(const IRExpr* e) {
  Times times = {0};
  switch (e->tag) {
    case Iex_RdTmp:
      include_atom(&times, e);
      break;
    case Iex_Get:
      return of_register(register_at(e->Iex.Get.offset));
    case Iex_GetI:
      return of_register(x87_register());
    case Iex_Unop:
      include_atom(&times, e->Iex.Unop.arg);
      break;
    case Iex_Binop:
      include_atom(&times, e->Iex.Binop.arg1);
      include_atom(&times, e->Iex.Binop.arg2);
      break;
    case Iex_Triop:
      include_atom(&times, e->Iex.Triop.details->arg2);
      include_atom(&times, e->Iex.Triop.details->arg3);
      break;
    case Iex_Qop:
      include_atom(&times, e->Iex.Qop.details->arg2);
      include_atom(&times, e->Iex.Qop.details->arg3);
      include_atom(&times, e->Iex.Qop.details->arg4);
      break;
    case Iex_Load:
      include_atom(&times, e->Iex.Load.addr);
      break;
    case Iex_ITE:
      include_atom(&times, e->Iex.ITE.cond);
      include_atom(&times, e->Iex.ITE.iftrue);
      include_atom(&times, e->Iex.ITE.iffalse);
      break;
    case Iex_CCall:
      for (IRExpr** argument = e->Iex.CCall.args; *argument != NULL; ++argument)
        include_atom(&times, *argument);
      break;
    default:
      break;
  }
  return times;
}
