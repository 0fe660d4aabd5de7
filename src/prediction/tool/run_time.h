/// What the code of the program calls while it runs, and what it leaves for that.
#pragma once

#include "prediction/timing/micro_ops.h"
#include "prediction/tool/predictor.h"

/// Words that a block writes: addresses of accesses, conditions, targets of indirect branches.
enum { max_words = 1024 };
extern ULong block_words[max_words];
/// A value of more than 8 bytes on its way to predict_long() and back.
extern Value shuttle;
/// Not 0 while instructions are counted; while values are predicted.
extern ULong counting, predicting;

ULong predict_word(Site* site, ULong value, ULong index);
void predict_long(Site* site, ULong index);
void run_segment(const Segment* segment);

/// The program is in this section and phase now (core/mark_codes.h).
void enter_section(UWord section);
void enter_phase(UWord phase);
/// The whole program is one section with --scope=program.
void begin_program(void);
/// Writes what was counted as JSON.
void write_report(void);
