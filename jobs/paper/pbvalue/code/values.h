/// The layout of a predicted value, and when two values count as equal.
#pragma once

#include <pub_tool_basics.h>

/// Bytes of the longest value (an AVX register).
enum { max_value_bytes = 32 };

/// A value is `num_lanes` numbers of `lane_bytes` (4: float, 8: double), or bits without a meaning
/// (lane_bytes 0), with `bytes` bytes in all. Bits are only compared for equality.
typedef struct {
  UChar bytes, lane_bytes, num_lanes;
} ValueType;

typedef union {
  ULong words[max_value_bytes / 8];
  Double f64[max_value_bytes / 8];
  Float f32[max_value_bytes / 4];
} Value;

/// The outcome of a prediction.
typedef enum { not_predicted, predicted_right, predicted_wrong } Outcome;

typedef enum { values_differ, values_near, values_equal } Likeness;

/// How a predicted value is verified. A threshold of 0 is the same as `exact`: zeros of different sign
/// differ.
typedef struct {
  Bool exact;
  Double threshold;
  Bool relative;  ///< threshold is relative to the magnitude of the computed value
} Verification;

/// Compares the predicted value with the computed one: equal bit for bit; near, if it is not verified exactly
/// and all lanes are finite and at most the threshold apart; otherwise different. `error`: the largest
/// distance of a lane if they are near [unit of the value, or 1].
Likeness compare_values(ValueType type, const Value* predicted, const Value* computed,
                        const Verification* verification, Double* error);
