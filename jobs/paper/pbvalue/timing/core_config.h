/// The parameters of the modelled processor.
#pragma once

#include "jobs/paper/pbvalue/code/ir_classes.h"
#include "jobs/paper/pbvalue/timing/memory_model.h"

enum { max_window = 4096, num_clusters = 4, queue_entries = 16 };

/// Defaults: Table 3 of the paper, and choices where it is silent (docs/research/prediction.md).
typedef struct {
  Int width, window, memory_queue, clusters;  ///< clusters 0: one queue without limits
  Int int_units, memory_units, fp_units;      ///< per cluster
  Int latency[num_op_kinds];
  Int level_latency[num_levels];
  Int front_end;  ///< cycles from fetch to the window: lost after a wrong guess
  Int redo;       ///< cycles after a misprediction until the dependents are issued again
  Bool predict, perfect_branches, perfect_caches;
} Config;

/// Reads "key=value,key=value" over the defaults. Ends the program with a message for invalid text.
Config read_config(const HChar* text);
/// Prints the keys, for --help.
void print_keys(void);
