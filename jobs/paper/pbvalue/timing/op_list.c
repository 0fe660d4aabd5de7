#include "jobs/paper/pbvalue/timing/op_list.h"

#include <pub_tool_libcassert.h>
#include <pub_tool_libcbase.h>

OpList op_list;

MicroOp* new_op(OpKind kind) {
  tl_assert(op_list.num_ops < max_ops);
  MicroOp* op = &op_list.ops[op_list.num_ops++];
  VG_(memset)(op, 0, sizeof *op);
  op->kind = (UChar)kind;
  op->dest = no_slot;
  op->site = op->word = -1;
  if (kind != op_join) {
    op->fetch = op_list.fetch;
    op_list.fetch = 0;
    op_list.has_op = True;
  }
  return op;
}

Slot new_slot(void) {
  tl_assert(op_list.next_slot < max_slots);
  return op_list.next_slot++;
}

void set_sources(MicroOp* op, const Times* times) {
  op->num_sources = times->count;
  VG_(memcpy)(op->source, times->slots, sizeof op->source);
}

void join(Times* times) {
  MicroOp* op = new_op(op_join);
  set_sources(op, times);
  op->dest = new_slot();
  times->count = 1;
  times->slots[0] = op->dest;
}

void include(Times* times, Slot slot) {
  for (Int i = 0; i < times->count; ++i) {
    if (times->slots[i] == slot) return;
  }
  if (times->count == max_sources) join(times);
  times->slots[times->count++] = slot;
}

void include_all(Times* times, const Times* others) {
  for (Int i = 0; i < others->count; ++i) include(times, others->slots[i]);
}

Times of_slot(Slot slot) {
  const Times times = {.count = 1, .slots = {slot}};
  return times;
}
