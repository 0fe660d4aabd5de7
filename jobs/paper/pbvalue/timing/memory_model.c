#include "jobs/paper/pbvalue/timing/memory_model.h"

enum {
  line_shift = 6,
  max_lines = (2 << 20) >> line_shift,
  history_bits = 16,
  btb_sets = 1024,
  btb_ways = 4
};

/// `lines` of a set are ordered by their last use, the latest first; 0 is an empty line.
typedef struct {
  UInt num_sets, num_ways;
  ULong lines[max_lines];
} Cache;

const HChar* const level_names[num_levels] = {"l1", "l2", "l3", "memory"};
MemoryCounts memory_counts;

// Table 3: 32 KB 4-way and 16 KB 4-way first levels, 256 KB 8-way, 2 MB 16-way; lines of 64 bytes are our
// choice.
static Cache l1_fetch = {.num_sets = (32 << 10 >> line_shift) / 4, .num_ways = 4};
static Cache l1_data = {.num_sets = (16 << 10 >> line_shift) / 4, .num_ways = 4};
static Cache l2 = {.num_sets = (256 << 10 >> line_shift) / 8, .num_ways = 8};
static Cache l3 = {.num_sets = (2 << 20 >> line_shift) / 16, .num_ways = 16};

static UChar counters[1 << history_bits];
static UInt history;
static struct { Addr address, target; } btb[btb_sets][btb_ways];

/// True on a hit. Moves the line to the front of its set.
static Bool touch(Cache* cache, ULong line) {
  ULong* set = &cache->lines[(line & (cache->num_sets - 1)) * cache->num_ways];
  UInt way = 0;
  while (way + 1 < cache->num_ways && set[way] != line) ++way;
  const Bool hit = set[way] == line;
  for (; way > 0; --way) set[way] = set[way - 1];
  set[0] = line;
  return hit;
}

static Level find(Cache* first, Addr address) {
  const ULong line = (address >> line_shift) + 1;
  if (touch(first, line)) return level_l1;
  if (touch(&l2, line)) return level_l2;
  return touch(&l3, line) ? level_l3 : level_memory;
}

Level data_access(Addr address) {
  const Level level = find(&l1_data, address);
  ++memory_counts.data[level];
  return level;
}

Level fetch_access(Addr address) {
  const Level level = find(&l1_fetch, address);
  ++memory_counts.fetch[level];
  return level;
}

Bool guess_branch(Addr address, Bool taken) {
  UChar* counter = &counters[(address ^ history) & ((1u << history_bits) - 1)];
  const Bool right = (*counter >= 2) == (taken != 0);
  if (taken && *counter < 3) ++*counter;
  if (!taken && *counter > 0) --*counter;
  history = (history << 1 | (taken ? 1u : 0u)) & ((1u << history_bits) - 1);
  ++memory_counts.branches;
  if (!right) ++memory_counts.branches_wrong;
  return right;
}

Bool guess_target(Addr address, Addr target) {
  const UInt set = address & (btb_sets - 1);
  UInt way = 0;
  while (way + 1 < btb_ways && btb[set][way].address != address) ++way;
  const Bool right = btb[set][way].address == address && btb[set][way].target == target;
  for (; way > 0; --way) btb[set][way] = btb[set][way - 1];
  btb[set][0].address = address;
  btb[set][0].target = target;
  if (!right) ++memory_counts.targets_wrong;
  return right;
}
