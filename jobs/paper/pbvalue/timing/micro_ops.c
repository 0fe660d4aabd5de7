#include "jobs/paper/pbvalue/timing/micro_ops.h"

#include <pub_tool_libcbase.h>
#include <pub_tool_machine.h>
#include <pub_tool_mallocfree.h>
#include "jobs/paper/pbvalue/timing/operand_times.h"
#include "jobs/paper/pbvalue/timing/register_times.h"

static struct {
  const IRSB* block;
  const Bool* needed;
  // State of the instruction.
  Addr pc;
  UInt length;
  Decoded decoded;
  Bool has_branch;
  Int int_op;  ///< index of its integer arithmetic, or -1
  Addr last_line;
  // State of the segment.
  UInt num_instructions, mix[num_mix_classes];
} b;

static Slot add_op(OpKind kind, const Times* sources, Short word, Short site) {
  MicroOp* op = new_op(kind);
  set_sources(op, sources);
  op->word = word;
  op->site = site;
  op->dest = new_slot();
  return op->dest;
}

/// All integer arithmetic of an instruction between two loads forms one operation.
static Slot add_int_op(OpKind kind, const Times* sources, Short site) {
  if (b.int_op < 0) {
    b.int_op = (Int)op_list.num_ops;
    const Slot slot = add_op(kind, sources, -1, site);
    b.int_op = (Int)op_list.num_ops - 1;
    return slot;
  }
  MicroOp* op = &op_list.ops[b.int_op];
  Times times = {.count = op->num_sources};
  VG_(memcpy)(times.slots, op->source, sizeof times.slots);
  for (Int i = 0; i < sources->count; ++i) {
    Bool is_known = sources->slots[i] == op->dest;
    for (Int k = 0; k < times.count; ++k) is_known = is_known || times.slots[k] == sources->slots[i];
    if (is_known) continue;
    if (times.count == max_sources) break;  // no integer instruction has as many operands
    times.slots[times.count++] = sources->slots[i];
  }
  set_sources(op, &times);
  if (kind > op->kind && kind <= op_int_div) op->kind = (UChar)kind;
  if (site >= 0) op->site = site;
  return op->dest;
}

static Times result_of(const IRTemp temp, const IRExpr* e, Short word, Short site) {
  Times times = times_of(e);
  if (e->tag == Iex_Load) {
    b.int_op = -1;
    return of_slot(add_op(op_load, &times, word, site));
  }
  const OpKind kind = facts_of(e, b.block->tyenv->types[temp]).kind;
  if (kind == op_join) return times;
  if (kind > op_int_div) return of_slot(add_op(kind, &times, -1, site));
  return b.needed[temp] ? of_slot(add_int_op(kind, &times, site)) : times;
}

static void add_put(Int offset, const IRExpr* data) {
  if (offset == 184) return;  // the program counter
  Times times = times_of(data);
  if (is_flags(offset) && b.int_op >= 0) include(&times, op_list.ops[b.int_op].dest);
  const IRType type = typeOfIRExpr(b.block->tyenv, data);
  set_register(register_at(offset), times, is_upper_part(offset) || type == Ity_I8 || type == Ity_I16);
}

static void add_store(const IRExpr* address, const IRExpr* data, Short word) {
  Times times = {0};
  include_atom(&times, address);
  include_atom(&times, data);
  MicroOp* op = new_op(op_store);
  set_sources(op, &times);
  op->word = word;
}

/// Helpers that Valgrind itself calls, and atomic accesses: one integer operation.
static void add_other(const IRStmt* s) {
  Times times = {0};
  if (s->tag == Ist_Dirty) {
    const IRDirty* dirty = s->Ist.Dirty.details;
    for (IRExpr** argument = dirty->args; *argument != NULL; ++argument) include_atom(&times, *argument);
    const Slot slot = add_int_op(op_int, &times, -1);
    if (dirty->tmp != IRTemp_INVALID) set_temp(dirty->tmp, of_slot(slot));
  } else if (s->tag == Ist_CAS) {
    const IRCAS* cas = s->Ist.CAS.details;
    include_atom(&times, cas->addr);
    include_atom(&times, cas->dataLo);
    const Slot slot = add_int_op(op_int, &times, -1);
    set_temp(cas->oldLo, of_slot(slot));
    if (cas->oldHi != IRTemp_INVALID) set_temp(cas->oldHi, of_slot(slot));
  } else if (s->tag == Ist_LoadG) {
    const IRLoadG* guarded = s->Ist.LoadG.details;
    include_atom(&times, guarded->addr);
    include_atom(&times, guarded->guard);
    include_atom(&times, guarded->alt);
    set_temp(guarded->dst, of_slot(add_int_op(op_int, &times, -1)));
  }
}

void add_statement(const IRStmt* s, Short word, Short site) {
  switch (s->tag) {
    case Ist_Put:
      add_put(s->Ist.Put.offset, s->Ist.Put.data);
      break;
    case Ist_PutI:
      set_register(x87_register(), times_of(s->Ist.PutI.details->data), True);
      break;
    case Ist_WrTmp:
      set_temp(s->Ist.WrTmp.tmp, result_of(s->Ist.WrTmp.tmp, s->Ist.WrTmp.data, word, site));
      break;
    case Ist_Store:
      add_store(s->Ist.Store.addr, s->Ist.Store.data, word);
      break;
    default:
      add_other(s);
      break;
  }
}

/// Adds an operation for an instruction that has none so far: a register-to-register move, a comparison
/// (whose flags are computed where they are used), or a no-op.
static void end_instruction(void) {
  if (b.length == 0 || op_list.has_op) return;
  const Times times = written_times();
  put_written(add_op(b.decoded.is_float ? op_fp_other : op_int, &times, -1, -1));
}

void begin_block(const IRSB* block, const Bool* needed) {
  forget_temps(block->tyenv->types_used);
  b.block = block;
  b.needed = needed;
  forget_registers();
  op_list.num_ops = 0;
  op_list.next_slot = num_registers;
  b.length = 0;
  b.last_line = 0;
  b.num_instructions = 0;
  VG_(memset)(b.mix, 0, sizeof b.mix);
}

void begin_instruction(Addr pc, UInt length, const Decoded* decoded) {
  if (num_models() > 0) end_instruction();
  ++b.num_instructions;
  for (Int i = 0; i < num_mix_classes; ++i) b.mix[i] += (decoded->mix >> i) & 1u;
  b.pc = pc;
  b.length = length;
  b.decoded = *decoded;
  op_list.has_op = b.has_branch = False;
  b.int_op = -1;
  op_list.fetch = pc >> 6 != b.last_line ? pc : 0;
  b.last_line = pc >> 6;
  begin_writes();
}

static MicroOp* branch_op(void) {
  if (b.int_op < 0) {
    const Times none = {0};
    add_int_op(op_int, &none, -1);
  }
  MicroOp* op = &op_list.ops[b.int_op];
  op->kind = op_branch;
  op->pc = b.pc;
  b.has_branch = True;
  return op;
}

void add_exit(const IRExpr* guard, Addr to, Short word) {
  Times times = {0};
  include_atom(&times, guard);
  add_int_op(op_int, &times, -1);
  MicroOp* op = branch_op();
  const Addr behind = b.pc + b.length;
  op->branch = branch_conditional;
  op->taken_if = to != behind;
  op->target = to;
  op->word = word;
}

void add_end(const IRExpr* next, IRJumpKind kind, Short word) {
  if (b.has_branch || b.decoded.branch == no_branch || b.decoded.branch == branch_conditional) return;
  Times times = {0};
  include_atom(&times, next);
  add_int_op(op_int, &times, -1);
  MicroOp* op = branch_op();
  op->branch = kind == Ijk_Ret ? branch_return : next->tag == Iex_Const ? branch_direct : branch_indirect;
  op->target = next->tag == Iex_Const ? (Addr)next->Iex.Const.con->Ico.U64 : 0;
  op->word = word;
}

Segment* end_segment(void) {
  Segment* segment = VG_(calloc)("pbvalue.segment", 1, sizeof *segment);
  segment->num_instructions = b.num_instructions;
  VG_(memcpy)(segment->mix, b.mix, sizeof b.mix);
  if (num_models() > 0) {
    end_instruction();
    b.length = 0;
    leave_registers();
    segment->num_ops = op_list.num_ops;
    segment->ops = VG_(malloc)("pbvalue.ops", (op_list.num_ops + 1) * sizeof(MicroOp));
    VG_(memcpy)(segment->ops, op_list.ops, op_list.num_ops * sizeof(MicroOp));
  }
  op_list.num_ops = 0;
  b.num_instructions = 0;
  b.int_op = -1;
  op_list.has_op = True;  // for an instruction that goes on after an exit
  begin_writes();
  VG_(memset)(b.mix, 0, sizeof b.mix);
  return segment;
}
