/// The command line of pbvalue.
#pragma once

#include <pub_tool_basics.h>

#include "jobs/paper/pbvalue/code/values.h"

typedef enum { scope_collision, scope_step, scope_all, scope_frame, scope_program } Scope;
typedef enum { replace_lru, replace_fifo, replace_random } Replacement;
enum { predict_fp = 1, predict_int = 2 };

typedef struct {
  const HChar* out_file;      ///< null: no file is written
  Verification verification;  ///< for floating-point values; integers are always verified exactly
  UInt predict;               ///< predict_fp | predict_int
  Scope scope;
  Int table_entries;  ///< a power of two; 0: one for each micro-operation of the program
  Int table_ways;
  Int tag_bits;  ///< 64: the whole key; 0: none, an operation takes any entry that it finds for its own
  Replacement replacement;
  Int confidence_max, confidence_use, confidence_up, confidence_down;
  Int first_modelled;  ///< sections before this one (per kind, from 0) are not given to the cycle models
  UInt modelled;       ///< bit i: sections of kind i (PbvalueSection) are given to the cycle models
} Options;

extern Options options;

/// True if `argument` is an option of this tool. Ends the program with a message for an invalid value.
Bool process_option(const HChar* argument);
void print_usage(void);
/// Ends the program with a message if two options do not go together.
void check_options(void);
