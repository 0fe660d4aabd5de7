#include "jobs/paper/pbvalue/timing/core_model.h"

#include <pub_tool_libcbase.h>
#include <pub_tool_libcprint.h>
#include <pub_tool_mallocfree.h>
#include <pub_tool_options.h>
#include "jobs/paper/pbvalue/timing/core_config.h"

enum { calendar_cycles = 4096, store_granules = 1 << 14 };
typedef enum { unit_int, unit_memory, unit_fp, num_units } Unit;

/// Operations issued in a cycle.
typedef struct {
  ULong cycle;
  UChar total, unit[num_clusters][num_units];
} Bookings;

typedef struct {
  const HChar *name, *text;
  Config config;
  ULong ready[max_slots];
  ULong fetch_cycle, last_leave;
  Int fetched, left;                                  ///< in the cycle fetch_cycle, and last_leave
  ULong leave[max_window], memory_leave[max_window];  ///< when the last operations left, as rings
  UInt at, memory_at, cluster;
  ULong queue[num_clusters][queue_entries];  ///< when each place of a cluster's window becomes free
  UInt next_place[num_clusters];
  ULong divider[num_clusters];  ///< when the divider becomes free: it takes one operation at a time
  Bookings calendar[calendar_cycles];
  struct {
    Addr granule;
    ULong ready;
  } store[store_granules];  ///< when the last store to 8 bytes has its data
} Model;

static Model* models[max_models];
static Int count;

Int num_models(void) { return count; }
const HChar* model_name(Int model) { return models[model]->name; }
const HChar* model_text(Int model) { return models[model]->text; }
ULong model_cycles(Int model) { return models[model]->last_leave; }

void print_model_usage(void) {
  VG_(printf)
  ("    --model=NAME:key=value,...      count the cycles of a processor; may be given up to %d times:\n",
   max_models);
  print_keys();
}

void add_model(const HChar* text) {
  if (count == max_models) VG_(fmsg_bad_option)("--model", "'%s': there are %d already\n", text, max_models);
  Model* model = VG_(calloc)("pbvalue.model", 1, sizeof(Model));
  HChar* name = VG_(strdup)("pbvalue.model.name", text);
  HChar* colon = VG_(strchr)(name, ':');
  model->name = name;
  model->text = colon == NULL ? "" : colon + 1;
  if (colon != NULL) *colon = '\0';
  model->config = read_config(model->text);
  models[count++] = model;
}

static ULong later(ULong a, ULong b) { return a > b ? a : b; }

static Unit unit_of(OpKind kind) {
  if (kind == op_load || kind == op_store) return unit_memory;
  return kind >= op_fp_add && kind <= op_fp_other ? unit_fp : unit_int;
}

static Int units(const Config* config, Unit unit) {
  return unit == unit_int ? config->int_units : unit == unit_memory ? config->memory_units : config->fp_units;
}

/// The first cycle from `earliest` on in which the machine and this unit of the cluster can take another
/// operation.
static ULong book(Model* model, ULong earliest, UInt cluster, Unit unit) {
  const Int limit =
      model->config.clusters == 0 ? units(&model->config, unit) * num_clusters : units(&model->config, unit);
  for (ULong cycle = earliest;; ++cycle) {
    Bookings* bookings = &model->calendar[cycle % calendar_cycles];
    if (bookings->cycle != cycle) *bookings = (Bookings){.cycle = cycle};
    if (bookings->total >= model->config.width || bookings->unit[cluster][unit] >= limit) continue;
    ++bookings->total;
    ++bookings->unit[cluster][unit];
    return cycle;
  }
}

/// Takes one of `width` places of a cycle, in order: advances `cycle` where it is full or `earliest` is
/// later.
static ULong take_place(ULong* cycle, Int* used, ULong earliest, Int width) {
  if (earliest > *cycle) {
    *cycle = earliest;
    *used = 0;
  } else if (*used == width) {
    ++*cycle;
    *used = 0;
  }
  ++*used;
  return *cycle;
}

/// A free place of a cluster's window, or the first to become free. Most are free: the search begins after
/// the last one taken.
static ULong* free_place(Model* model, UInt cluster) {
  ULong* queue = model->queue[cluster];
  UInt first = model->next_place[cluster];
  for (UInt i = 0; i < queue_entries; ++i) {
    const UInt at = (model->next_place[cluster] + i) % queue_entries;
    if (queue[at] < queue[first]) first = at;
    if (queue[first] <= model->fetch_cycle) break;
  }
  model->next_place[cluster] = (first + 1) % queue_entries;
  return &queue[first];
}

/// When the operation enters the window: after fetch, when there is room in window, load/store queue and
/// cluster.
static ULong enter(Model* model, const MicroOp* op, const Event* event, UInt cluster, ULong** place) {
  const Config* config = &model->config;
  ULong earliest = model->leave[model->at];
  if (op->fetch != 0 && event->fetch_level != level_l1 && !config->perfect_caches)
    earliest = later(earliest, model->fetch_cycle + (ULong)config->level_latency[event->fetch_level]);
  if (op->kind == op_load || op->kind == op_store)
    earliest = later(earliest, model->memory_leave[model->memory_at]);
  if (config->clusters != 0) {
    *place = free_place(model, cluster);
    earliest = later(earliest, **place);
  }
  return take_place(&model->fetch_cycle, &model->fetched, earliest, config->width);
}

static ULong operands_ready(const Model* model, const MicroOp* op, ULong entered) {
  ULong ready = entered;
  for (Int i = 0; i < op->num_sources; ++i) ready = later(ready, model->ready[op->source[i]]);
  return ready;
}

/// When a memory access is done. A load from the address of a store in the queue waits for the store's data,
/// and takes it from there with the latency of the first level.
static ULong access_memory(Model* model, const MicroOp* op, const Event* event, ULong issued) {
  const Addr granule = event->address >> 3;
  const UInt at = (UInt)(granule & (store_granules - 1));
  if (op->kind == op_store) {
    model->store[at].granule = granule;
    model->store[at].ready = issued + 1;
    return issued + 1;
  }
  const Bool in_queue = model->store[at].granule == granule && model->store[at].ready > issued;
  if (in_queue) return model->store[at].ready + (ULong)model->config.level_latency[level_l1];
  const Level level = model->config.perfect_caches ? level_l1 : (Level)event->level;
  return issued + (ULong)model->config.level_latency[level];
}

static ULong execute(Model* model, const MicroOp* op, const Event* event, ULong ready, UInt cluster,
                     ULong* issued) {
  const Bool divides = op->kind == op_fp_div || op->kind == op_fp_sqrt || op->kind == op_int_div;
  if (divides) ready = later(ready, model->divider[cluster]);
  *issued = book(model, ready, cluster, unit_of(op->kind));
  if (op->kind == op_load || op->kind == op_store) return access_memory(model, op, event, *issued);
  const ULong done = *issued + (ULong)model->config.latency[op->kind];
  if (divides) model->divider[cluster] = done;
  return done;
}

static void leave(Model* model, const MicroOp* op, ULong done) {
  const Config* config = &model->config;
  const ULong left = take_place(&model->last_leave, &model->left, done, config->width);
  model->leave[model->at] = left;
  model->at = model->at + 1 == (UInt)config->window ? 0 : model->at + 1;
  if (op->kind == op_load || op->kind == op_store) {
    model->memory_leave[model->memory_at] = left;
    model->memory_at = model->memory_at + 1 == (UInt)config->memory_queue ? 0 : model->memory_at + 1;
  }
}

static void step(Model* model, const MicroOp* op, const Event* event) {
  const Config* config = &model->config;
  if (op->kind == op_join) {
    model->ready[op->dest] = operands_ready(model, op, 0);
    return;
  }
  const UInt cluster = model->cluster;
  if (config->clusters != 0) model->cluster = cluster + 1 == (UInt)config->clusters ? 0 : cluster + 1;
  ULong* place = NULL;
  const ULong entered = enter(model, op, event, cluster, &place);
  ULong issued = 0;
  const ULong done = execute(model, op, event, operands_ready(model, op, entered + 1), cluster, &issued);
  if (place != NULL) *place = issued;
  if (op->dest != no_slot) {
    const Bool predicts = config->predict && event->outcome != not_predicted;
    model->ready[op->dest] = !predicts                           ? done
                             : event->outcome == predicted_right ? entered
                                                                 : done + (ULong)config->redo;
  }
  if (event->mispredicted && !config->perfect_branches) {
    model->fetch_cycle = later(model->fetch_cycle, done + (ULong)config->front_end);
    model->fetched = 0;
  }
  leave(model, op, done);
}

void model_step(const MicroOp* op, const Event* event) {
  for (Int i = 0; i < count; ++i) step(models[i], op, event);
}
