#include "jobs/paper/pbvalue/code/values.h"

static Double lane_of(ValueType type, const Value* value, Int lane) {
  return type.lane_bytes == 8 ? value->f64[lane] : (Double)value->f32[lane];
}

static Double magnitude(Double x) { return x < 0 ? -x : x; }

/// False for NaN: a comparison with it is false.
static Bool is_finite(Double x) { return magnitude(x) <= 1.7976931348623157e308; }

Likeness compare_values(ValueType type, const Value* predicted, const Value* computed,
                        const Verification* verification, Double* error) {
  ULong difference = 0;
  for (Int word = 0; 8 * word < type.bytes; ++word)
    difference |= predicted->words[word] ^ computed->words[word];
  *error = 0;
  if (difference == 0) return values_equal;
  if (verification->exact || type.lane_bytes == 0) return values_differ;
  const Double threshold = verification->threshold;
  for (Int lane = 0; lane < type.num_lanes; ++lane) {
    const Double expected = lane_of(type, computed, lane), guess = lane_of(type, predicted, lane);
    if (!is_finite(expected) || !is_finite(guess)) return values_differ;
    const Double distance = magnitude(expected - guess);
    const Double measured =
        verification->relative && distance > 0 ? distance / magnitude(expected) : distance;
    if (!(threshold > 0 && measured <= threshold)) return values_differ;
    if (measured > *error) *error = measured;
  }
  return values_near;
}
