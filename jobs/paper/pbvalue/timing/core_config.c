#include "jobs/paper/pbvalue/timing/core_config.h"

#include <pub_tool_libcbase.h>
#include <pub_tool_libcprint.h>
#include <pub_tool_options.h>

typedef struct {
  const HChar* name;
  SizeT offset;
  const HChar* meaning;
} Key;

static const Key keys[] = {
    {"width", __builtin_offsetof(Config, width), "micro-operations that enter, issue and leave a cycle [8]"},
    {"window", __builtin_offsetof(Config, window), "instruction window [192]"},
    {"memory_queue", __builtin_offsetof(Config, memory_queue), "load/store queue [144]"},
    {"clusters", __builtin_offsetof(Config, clusters),
     "clusters of 16 entries, 1 to 4; 0: no limit and no clusters [4]"},
    {"int_units", __builtin_offsetof(Config, int_units), "a cluster's integer units [4]"},
    {"memory_units", __builtin_offsetof(Config, memory_units), "memory ports [2]"},
    {"fp_units", __builtin_offsetof(Config, fp_units), "floating-point units [2]"},
    {"int", __builtin_offsetof(Config, latency[op_int]), "latency of integer operations and branches [1]"},
    {"int_mul", __builtin_offsetof(Config, latency[op_int_mul]), "[3]"},
    {"int_div", __builtin_offsetof(Config, latency[op_int_div]), "[20]"},
    {"fp_add", __builtin_offsetof(Config, latency[op_fp_add]), "[4]"},
    {"fp_mul", __builtin_offsetof(Config, latency[op_fp_mul]), "[4]"},
    {"fp_div", __builtin_offsetof(Config, latency[op_fp_div]), "[20]"},
    {"fp_sqrt", __builtin_offsetof(Config, latency[op_fp_sqrt]), "[27]"},
    {"fp_other", __builtin_offsetof(Config, latency[op_fp_other]), "conversions, comparisons, logic [2]"},
    {"l1", __builtin_offsetof(Config, level_latency[level_l1]), "[2]"},
    {"l2", __builtin_offsetof(Config, level_latency[level_l2]), "[7]"},
    {"l3", __builtin_offsetof(Config, level_latency[level_l3]), "[16]"},
    {"memory", __builtin_offsetof(Config, level_latency[level_memory]), "[160]"},
    {"front_end", __builtin_offsetof(Config, front_end),
     "cycles lost after a branch that was guessed wrong [6]"},
    {"redo", __builtin_offsetof(Config, redo), "cycles until dependents of a misprediction issue again [1]"},
    {"predict", __builtin_offsetof(Config, predict), "1: predictions make values available early [0]"},
    {"perfect_branches", __builtin_offsetof(Config, perfect_branches), "1: no branch is guessed wrong [0]"},
    {"perfect_caches", __builtin_offsetof(Config, perfect_caches),
     "1: every access hits the first level [0]"},
};
enum { num_keys = sizeof keys / sizeof keys[0] };

static const Config table_3 = {.width = 8,
                               .window = 192,
                               .memory_queue = 144,
                               .clusters = num_clusters,
                               .int_units = 4,
                               .memory_units = 2,
                               .fp_units = 2,
                               .latency = {[op_int] = 1,
                                           [op_int_mul] = 3,
                                           [op_int_div] = 20,
                                           [op_fp_add] = 4,
                                           [op_fp_mul] = 4,
                                           [op_fp_div] = 20,
                                           [op_fp_sqrt] = 27,
                                           [op_fp_other] = 2,
                                           [op_store] = 1,
                                           [op_branch] = 1},
                               .level_latency = {2, 7, 16, 160},
                               .front_end = 6,
                               .redo = 1};

/// A Bool is one byte, all other members are Ints.
static void set_key(Config* config, const Key* key, Long value) {
  UChar* place = (UChar*)config + key->offset;
  if (key->offset >= __builtin_offsetof(Config, predict)) {
    *(Bool*)place = value != 0;
  } else {
    *(Int*)place = (Int)value;
  }
}

/// Takes "key=value" from `text`, and returns the remaining text.
static const HChar* take_key(Config* config, const HChar* text, const HChar* all) {
  for (Int i = 0; i < num_keys; ++i) {
    const SizeT length = VG_(strlen)(keys[i].name);
    if (VG_(strncmp)(text, keys[i].name, length) != 0 || text[length] != '=') continue;
    HChar* end = NULL;
    const Long value = VG_(strtoll10)(text + length + 1, &end);
    if (end == text + length + 1 || value < 0 || value > 100000)
      VG_(fmsg_bad_option)("--model", "'%s': %s takes a whole number up to 100000\n", all, keys[i].name);
    set_key(config, &keys[i], value);
    return end;
  }
  VG_(fmsg_bad_option)("--model", "'%s': no key at '%s'; see --help\n", all, text);
  return NULL;
}

static void check(const Config* config, const HChar* text) {
  const Bool fits = config->width >= 1 && config->width <= 64 && config->window >= 1 &&
                    config->window <= max_window && config->memory_queue >= 1 &&
                    config->memory_queue <= max_window && config->clusters <= num_clusters &&
                    config->int_units >= 1 && config->int_units <= 64 && config->memory_units >= 1 &&
                    config->memory_units <= 64 && config->fp_units >= 1 && config->fp_units <= 64;
  if (!fits) {
    VG_(fmsg_bad_option)
    ("--model", "'%s': width and units are 1 to 64, window and memory_queue 1 to %d, clusters up to %d\n",
     text, max_window, num_clusters);
  }
}

Config read_config(const HChar* text) {
  Config config = table_3;
  const HChar* at = text;
  while (*at != '\0') {
    at = take_key(&config, at, text);
    if (*at == ',') {
      ++at;
    } else if (*at != '\0') {
      VG_(fmsg_bad_option)("--model", "'%s': a comma is missing at '%s'\n", text, at);
    }
  }
  check(&config, text);
  return config;
}

void print_keys(void) {
  for (Int i = 0; i < num_keys; ++i)
    VG_(printf)("                                      %s: %s\n", keys[i].name, keys[i].meaning);
}
