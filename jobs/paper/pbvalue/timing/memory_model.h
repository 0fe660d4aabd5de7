/// The caches and the branch predictor of Table 3. They see the program in its order, so that one instance
/// serves all cycle models.
#pragma once

#include <pub_tool_basics.h>

/// The level at which an access finds its line; each level's latency belongs to the cycle model.
typedef enum { level_l1, level_l2, level_l3, level_memory, num_levels } Level;
extern const HChar* const level_names[num_levels];

Level data_access(Addr address);
Level fetch_access(Addr address);

/// gshare over the last 16 conditional branches, 64 K two-bit counters. True if it guessed right.
Bool guess_branch(Addr address, Bool taken);
/// The branch target buffer, 4 K entries of 4 ways. True if it held this target.
Bool guess_target(Addr address, Addr target);

typedef struct {
  ULong data[num_levels], fetch[num_levels];
  ULong branches, branches_wrong;  ///< conditional ones
  ULong targets_wrong;             ///< taken branches whose target the buffer did not hold
  ULong indirect_wrong;            ///< the indirect ones among these: they were guessed wrong
} MemoryCounts;
extern MemoryCounts memory_counts;
