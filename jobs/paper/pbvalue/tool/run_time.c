#include "jobs/paper/pbvalue/tool/run_time.h"

#include <pub_tool_libcbase.h>
#include <pub_tool_mallocfree.h>
#include <pub_tool_xarray.h>
#include "core/mark_codes.h"
#include "jobs/paper/pbvalue/tool/options.h"
#include "jobs/paper/pbvalue/tool/report.h"

ULong block_words[max_words];
Value shuttle;
ULong counting, predicting;

static UChar outcomes[max_words];
static Counts now;
static UWord section = pbvalue_no_section, phase = pbvalue_no_phase;
static Int sections_seen[3];
static Bool modelled;
static XArray* records;  ///< of Record

ULong predict_word(Site* site, ULong value, ULong index) {
  Value whole = {.words = {value}};
  outcomes[index] = (UChar)predict(site, &whole);
  return whole.words[0];
}

void predict_long(Site* site, ULong index) {
  Value whole = shuttle;
  for (Int word = site->type.bytes / 8; word < max_value_bytes / 8; ++word) whole.words[word] = 0;
  outcomes[index] = (UChar)predict(site, &whole);
  for (Int word = 0; word < site->type.bytes / 8; ++word) shuttle.words[word] = whole.words[word];
}

/// Was the branch guessed wrong? gshare guesses a conditional branch, the target buffer an indirect one. A
/// direct one whose target the buffer does not hold is found when it is decoded; returns come from a stack
/// without limits.
static Bool guess(const MicroOp* op) {
  if (op->branch == branch_conditional) {
    const Bool taken = (block_words[op->word] != 0) == (op->taken_if != 0);
    return !guess_branch(op->pc, taken);
  }
  if (op->branch == branch_indirect) {
    const Bool wrong = !guess_target(op->pc, block_words[op->word]);
    if (wrong) ++memory_counts.indirect_wrong;
    return wrong;
  }
  if (op->branch == branch_direct) guess_target(op->pc, op->target);
  return False;
}

static void run_ops(const Segment* segment) {
  for (UInt i = 0; i < segment->num_ops; ++i) {
    const MicroOp* op = &segment->ops[i];
    Event event = {0};
    if (op->fetch != 0) event.fetch_level = (UChar)fetch_access(op->fetch);
    if (op->kind == op_load || op->kind == op_store) {
      event.address = block_words[op->word];
      event.level = (UChar)data_access(event.address);
    }
    if (op->kind == op_branch) event.mispredicted = guess(op);
    if (op->site >= 0) event.outcome = outcomes[op->site];
    if (op->kind != op_join) ++now.micro_ops;
    model_step(op, &event);
  }
}

void run_segment(const Segment* segment) {
  now.instructions[phase] += segment->num_instructions;
  for (Int i = 0; i < num_mix_classes; ++i) now.mix[i] += segment->mix[i];
  if (modelled) run_ops(segment);
  for (UInt i = 0; i < segment->num_ops; ++i) {
    if (segment->ops[i].site >= 0) outcomes[segment->ops[i].site] = not_predicted;
  }
}

static Bool in_scope(void) {
  switch (options.scope) {
    case scope_collision:
      return phase == pbvalue_collision;
    case scope_step:
      return phase == pbvalue_forward;
    case scope_all:
      return phase != pbvalue_no_phase;
    default:
      return True;
  }
}

static Counts all_counts(void) {
  Counts counts = now;
  VG_(memcpy)(counts.classes, class_counts, sizeof class_counts);
  counts.memory = memory_counts;
  for (Int i = 0; i < num_models(); ++i) counts.cycles[i] = model_cycles(i);
  return counts;
}

static void open_record(void) {
  if (records == NULL) records = VG_(newXA)(VG_(malloc), "pbvalue.records", VG_(free), sizeof(Record));
  reset_error_max();
  Record record = {.section = (UInt)section, .modelled = modelled, .at_begin = all_counts()};
  VG_(addToXA)(records, &record);
}

static void close_record(void) {
  Record* record = VG_(indexXA)(records, VG_(sizeXA)(records) - 1);
  record->at_end = all_counts();
  record->is_closed = True;
}

static void update_flags(void) {
  counting = section != pbvalue_no_section;
  predicting = counting != 0 && options.predict != 0 && in_scope();
}

void enter_section(UWord entered) {
  if (options.scope == scope_program || entered > pbvalue_estimate) return;
  if (section != pbvalue_no_section) close_record();
  section = entered;
  if (section != pbvalue_no_section) {
    const Bool is_late_enough = sections_seen[section]++ >= options.first_modelled;
    modelled = num_models() > 0 && is_late_enough && (options.modelled >> section & 1u) != 0;
    open_record();
  }
  update_flags();
}

void enter_phase(UWord entered) {
  if (entered > pbvalue_forward) return;
  phase = entered;
  update_flags();
}

void begin_program(void) {
  if (options.scope != scope_program) return;
  section = pbvalue_precise;
  modelled = num_models() > 0;
  open_record();
  update_flags();
}

void write_report(void) {
  if (section != pbvalue_no_section) close_record();
  section = pbvalue_no_section;
  report(records);
}
