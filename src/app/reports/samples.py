"""Order statistics and means over samples: lists or arrays of numbers."""
import dataclasses
import math

import numpy as np


def total(values):
    """The sum of numbers one after the other, along the first axis: numpy adds long rows in pairs, which gives other last digits."""
    values = np.asarray(values, dtype=float)
    return np.add.accumulate(values)[-1] if len(values) else np.zeros(values.shape[1:])[()]


def quantile(values, q):
    """The q-quantile (0 <= q <= 1) with linear interpolation between order statistics; 0 for an empty sample."""
    if len(values) == 0:
        return 0.0
    values = sorted(map(float, values))
    place = q * (len(values) - 1)
    low = int(place)
    return values[low] + (place - low) * (values[min(low + 1, len(values) - 1)] - values[low])


@dataclasses.dataclass
class Interval:
    """`confidence`: the probability that it contains the wanted number."""
    low: float
    high: float
    confidence: float


def median_interval(values, confidence):
    """An Interval for the median of the distribution, of any shape, from which `values`, one or more, are a sample: the narrowest pair of
    order statistics, equally far from either end, with at least `confidence`; for a sample too small for that the first and the last, with
    less. The median is not below the k-th value with the probability that at least k of n tosses show heads (David and Nagaraja, Order
    Statistics, 2003, section 7.1)."""
    values = sorted(map(float, values))
    num = len(values)
    found, outside = None, 0  # of the 2^num outcomes, those with the median below the k-th from the bottom or above the k-th from the top
    for k in range((num + 1) // 2):
        outside += 2 * math.comb(num, k)
        held = max(0.0, 1 - outside / 2 ** num)
        if found and held < confidence:
            break
        found = Interval(values[k], values[num - 1 - k], held)
    return found
