/// The functions that the program's instrumented code calls, and the data that it leaves for them.
#pragma once

#include "jobs/paper/pbvalue/timing/micro_ops.h"
#include "jobs/paper/pbvalue/tool/predictor.h"

/// Words that a block writes: addresses of accesses, conditions, targets of indirect branches.
enum { max_words = 1024 };
extern ULong block_words[max_words];
/// Passes a value of more than 8 bytes to predict_long() and back.
extern Value shuttle;
/// Nonzero while instructions are counted, and while values are predicted.
extern ULong counting, predicting;

ULong predict_word(Site* site, ULong value, ULong index);
void predict_long(Site* site, ULong index);
void run_segment(const Segment* segment);

/// Called when the program enters this section and phase (core/mark_codes.h).
void enter_section(UWord section);
void enter_phase(UWord phase);
/// Makes the whole program one section with --scope=program.
void begin_program(void);
/// Writes the counts as JSON.
void write_report(void);
