#include "prediction/timing/micro_ops.h"

#include <pub_tool_libcassert.h>
#include <pub_tool_libcbase.h>
#include <pub_tool_machine.h>
#include <pub_tool_mallocfree.h>

enum { num_registers = 128, max_ops = 2048, ymm_bytes = 32, stack_register = 60 };

/// When a value is there: at the latest of these times.
typedef struct {
  UChar count;
  Slot slots[max_sources];
} Times;

static struct {
  const IRSB* block;
  const Bool* needed;
  Times* temps;
  Times registers[num_registers];  ///< where `is_set`; else the register's own slot
  Bool is_set[num_registers];
  MicroOp ops[max_ops];
  UInt num_ops;
  Slot next_slot;
  // of the instruction
  Addr pc;
  UInt length;
  Decoded decoded;
  Bool has_op, has_branch;
  Int int_op;  ///< that of its integer arithmetic, or -1
  Addr fetch, last_line;
  UChar set_here[num_registers];
  // of the segment
  UInt num_instructions, mix[num_mix_classes];
} b;

static UInt register_at(Int offset) {
  if (offset < 224) return (UInt)offset / 8;
  const UInt ymm = 32 + ((UInt)offset - 224) / ymm_bytes;
  return ymm < stack_register ? ymm : stack_register;
}

static void include(Times* times, Slot slot);

static MicroOp* new_op(OpKind kind) {
  tl_assert(b.num_ops < max_ops);
  MicroOp* op = &b.ops[b.num_ops++];
  VG_(memset)(op, 0, sizeof *op);
  op->kind = (UChar)kind;
  op->dest = no_slot;
  op->site = op->word = -1;
  if (kind != op_join) {
    op->fetch = b.fetch;
    b.fetch = 0;
    b.has_op = True;
  }
  return op;
}

static Slot new_slot(void) {
  tl_assert(b.next_slot < max_slots);
  return b.next_slot++;
}

static void set_sources(MicroOp* op, const Times* times) {
  op->num_sources = times->count;
  VG_(memcpy)(op->source, times->slots, sizeof op->source);
}

/// More than an operation can wait for becomes one time.
static void join(Times* times) {
  MicroOp* op = new_op(op_join);
  set_sources(op, times);
  op->dest = new_slot();
  times->count = 1;
  times->slots[0] = op->dest;
}

static void include(Times* times, Slot slot) {
  for (Int i = 0; i < times->count; ++i) {
    if (times->slots[i] == slot) return;
  }
  if (times->count == max_sources) join(times);
  times->slots[times->count++] = slot;
}

static void include_all(Times* times, const Times* others) {
  for (Int i = 0; i < others->count; ++i) include(times, others->slots[i]);
}

static Times of_slot(Slot slot) {
  const Times times = {.count = 1, .slots = {slot}};
  return times;
}

static Times of_register(UInt reg) { return b.is_set[reg] ? b.registers[reg] : of_slot((Slot)reg); }

static void include_atom(Times* times, const IRExpr* atom) {
  if (atom != NULL && atom->tag == Iex_RdTmp) include_all(times, &b.temps[atom->Iex.RdTmp.tmp]);
}

/// Operands of an expression, which is flat: atoms only.
static Times times_of(const IRExpr* e) {
  Times times = {0};
  switch (e->tag) {
    case Iex_RdTmp:
      include_atom(&times, e);
      break;
    case Iex_Get:
      return of_register(register_at(e->Iex.Get.offset));
    case Iex_GetI:
      return of_register(stack_register);
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

static Slot add_op(OpKind kind, const Times* sources, Short word, Short site) {
  MicroOp* op = new_op(kind);
  set_sources(op, sources);
  op->word = word;
  op->site = site;
  op->dest = new_slot();
  return op->dest;
}

/// All integer arithmetic of an instruction between two loads is one operation.
static Slot add_int_op(OpKind kind, const Times* sources, Short site) {
  if (b.int_op < 0) {
    b.int_op = (Int)b.num_ops;
    const Slot slot = add_op(kind, sources, -1, site);
    b.int_op = (Int)b.num_ops - 1;
    return slot;
  }
  MicroOp* op = &b.ops[b.int_op];
  Times times = {.count = op->num_sources};
  VG_(memcpy)(times.slots, op->source, sizeof times.slots);
  for (Int i = 0; i < sources->count; ++i) {
    Bool is_known = sources->slots[i] == op->dest;
    for (Int k = 0; k < times.count; ++k) is_known = is_known || times.slots[k] == sources->slots[i];
    if (is_known) continue;
    if (times.count == max_sources) break;  // no instruction of integers has as many operands
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

static void set_register(UInt reg, Times times, Bool in_part) {
  if (in_part) {
    const Times before = of_register(reg);
    include_all(&times, &before);
  }
  b.registers[reg] = times;
  b.is_set[reg] = True;
  b.set_here[reg] = 1;
}

/// The flags are computed from operands later on in Valgrind's representation, in a processor with the
/// result.
static Bool is_flags(Int offset) { return offset >= 144 && offset < 176; }

static void add_put(Int offset, const IRExpr* data) {
  if (offset == 184) return;  // the program counter
  Times times = times_of(data);
  if (is_flags(offset) && b.int_op >= 0) include(&times, b.ops[b.int_op].dest);
  const IRType type = typeOfIRExpr(b.block->tyenv, data);
  const Bool is_upper = offset >= 224 && (offset - 224) % ymm_bytes != 0;
  set_register(register_at(offset), times, is_upper || type == Ity_I8 || type == Ity_I16);
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
    if (dirty->tmp != IRTemp_INVALID) b.temps[dirty->tmp] = of_slot(slot);
  } else if (s->tag == Ist_CAS) {
    const IRCAS* cas = s->Ist.CAS.details;
    include_atom(&times, cas->addr);
    include_atom(&times, cas->dataLo);
    const Slot slot = add_int_op(op_int, &times, -1);
    b.temps[cas->oldLo] = of_slot(slot);
    if (cas->oldHi != IRTemp_INVALID) b.temps[cas->oldHi] = of_slot(slot);
  } else if (s->tag == Ist_LoadG) {
    const IRLoadG* guarded = s->Ist.LoadG.details;
    include_atom(&times, guarded->addr);
    include_atom(&times, guarded->guard);
    include_atom(&times, guarded->alt);
    b.temps[guarded->dst] = of_slot(add_int_op(op_int, &times, -1));
  }
}

void add_statement(const IRStmt* s, Short word, Short site) {
  switch (s->tag) {
    case Ist_Put:
      add_put(s->Ist.Put.offset, s->Ist.Put.data);
      break;
    case Ist_PutI:
      set_register(stack_register, times_of(s->Ist.PutI.details->data), True);
      break;
    case Ist_WrTmp:
      b.temps[s->Ist.WrTmp.tmp] = result_of(s->Ist.WrTmp.tmp, s->Ist.WrTmp.data, word, site);
      break;
    case Ist_Store:
      add_store(s->Ist.Store.addr, s->Ist.Store.data, word);
      break;
    default:
      add_other(s);
      break;
  }
}

/// A register-to-register move, a comparison (whose flags are computed where they are used), or nothing at
/// all.
static void end_instruction(void) {
  if (b.length == 0 || b.has_op) return;
  Times times = {0};
  for (UInt reg = 0; reg < num_registers; ++reg) {
    if (b.set_here[reg]) include_all(&times, &b.registers[reg]);
  }
  const Slot slot = add_op(b.decoded.is_float ? op_fp_other : op_int, &times, -1, -1);
  for (UInt reg = 0; reg < num_registers; ++reg) {
    if (b.set_here[reg]) b.registers[reg] = of_slot(slot);
  }
}

void begin_block(const IRSB* block, const Bool* needed) {
  if (b.temps != NULL) VG_(free)(b.temps);
  b.temps = VG_(calloc)("pbvalue.times", (SizeT)block->tyenv->types_used + 1, sizeof(Times));
  b.block = block;
  b.needed = needed;
  VG_(memset)(b.is_set, 0, sizeof b.is_set);
  b.num_ops = 0;
  b.next_slot = num_registers;
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
  b.has_op = b.has_branch = False;
  b.int_op = -1;
  b.fetch = pc >> 6 != b.last_line ? pc : 0;
  b.last_line = pc >> 6;
  VG_(memset)(b.set_here, 0, sizeof b.set_here);
}

static MicroOp* branch_op(void) {
  if (b.int_op < 0) {
    const Times none = {0};
    add_int_op(op_int, &none, -1);
  }
  MicroOp* op = &b.ops[b.int_op];
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

/// What follows a segment finds the times of registers in their own slots.
static void write_registers(void) {
  for (UInt reg = 0; reg < num_registers; ++reg) {
    if (!b.is_set[reg]) continue;
    const Times* times = &b.registers[reg];
    if (times->count != 1 || times->slots[0] != reg) {
      MicroOp* op = new_op(op_join);
      set_sources(op, times);
      op->dest = (Slot)reg;
    }
    b.registers[reg] = of_slot((Slot)reg);
  }
}

/// The join of one register would overwrite what that of another still waits for, where a block exchanges
/// registers: those come first into slots of their own.
static void free_from_registers(void) {
  for (UInt reg = 0; reg < num_registers; ++reg) {
    if (!b.is_set[reg]) continue;
    Times* times = &b.registers[reg];
    for (Int i = 0; i < times->count; ++i) {
      const Slot slot = times->slots[i];
      if (slot < num_registers && slot != reg && b.is_set[slot]) {
        join(times);
        break;
      }
    }
  }
}

Segment* end_segment(void) {
  Segment* segment = VG_(calloc)("pbvalue.segment", 1, sizeof *segment);
  segment->num_instructions = b.num_instructions;
  VG_(memcpy)(segment->mix, b.mix, sizeof b.mix);
  if (num_models() > 0) {
    end_instruction();
    b.length = 0;
    free_from_registers();
    write_registers();
    segment->num_ops = b.num_ops;
    segment->ops = VG_(malloc)("pbvalue.ops", (b.num_ops + 1) * sizeof(MicroOp));
    VG_(memcpy)(segment->ops, b.ops, b.num_ops * sizeof(MicroOp));
  }
  b.num_ops = 0;
  b.num_instructions = 0;
  b.int_op = -1;
  b.has_op = True;  // of an instruction that goes on after an exit
  VG_(memset)(b.set_here, 0, sizeof b.set_here);
  VG_(memset)(b.mix, 0, sizeof b.mix);
  return segment;
}
