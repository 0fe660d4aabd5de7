/// Last-value prediction: the table, its entries' confidence, and the outcomes.
#pragma once

#include <pub_tool_basics.h>
#include "jobs/paper/pbvalue/code/values.h"

/// Classes of micro-operations whose results are counted separately.
typedef enum {
  class_fp_load,
  class_fp_operation,
  class_int_load,
  class_int_operation,
  num_classes
} ValueClass;
extern const HChar* const class_names[num_classes];

/// A micro-operation of the program: one statement of one instruction.
typedef struct {
  ULong key;  ///< address of the instruction, then 4 bits for the statement within it
  ValueType type;
  UChar value_class;
  UInt first_entry;  ///< in the table: its set begins here
  ULong tag;
} Site;

/// Counts since the start. `executed` = without an entry + below the confidence + right + wrong; `exact` and
/// `fuzzy` are the right ones.
typedef struct {
  ULong executed, exact, fuzzy, wrong;
  ULong repeated;    ///< times that the entry's value was computed again, whether confident or not
  Double error_sum;  ///< over the fuzzy hits
  Double error_max;  ///< over the fuzzy hits since reset_error_max()
} ClassCounts;
extern ClassCounts class_counts[num_classes];
void reset_error_max(void);

/// Called once, after the options are known.
void make_table(void);
/// The site of statement `id` (0 to 15) at `address`; the same one each time. Values longer than
/// max_value_bytes have no site.
Site* find_site(Addr address, UInt id, ValueClass value_class, ValueType type);

/// One execution: looks up the last value, verifies it, and trains the entry with the computed value. On a
/// fuzzy hit `value` becomes the predicted one.
Outcome predict(Site* site, Value* value);
