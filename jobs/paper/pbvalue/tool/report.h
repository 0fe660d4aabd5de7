/// The file that pbvalue writes.
#pragma once

#include <pub_tool_xarray.h>
#include "jobs/paper/pbvalue/code/decode.h"
#include "jobs/paper/pbvalue/timing/core_model.h"
#include "jobs/paper/pbvalue/tool/predictor.h"

typedef struct {
  ULong instructions[3];  ///< outside of the phases, in collision, in the forward step (PbvaluePhase)
  ULong mix[num_mix_classes];
  ULong micro_ops;
  ClassCounts classes[num_classes];
  MemoryCounts memory;
  ULong cycles[max_models];
} Counts;

/// One section of the program (PbvalueSection).
typedef struct {
  UInt section;
  Bool modelled, is_closed;
  Counts at_begin, at_end;
} Record;

/// Writes options and records (null: none) to --pbvalue-out-file, if there is one.
void report(XArray* records);
