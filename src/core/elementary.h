/// Elementary functions with the same bits on every machine: they use only operations that IEEE 754 rounds.
/// The C library has several versions of each function, chooses one by the CPU, and these differ in their
/// last bits. Code that a state depends on takes its functions from here.
///
/// The series are Taylor's, after the argument has been reduced until few terms are left (J.-M. Muller,
/// "Elementary Functions: Algorithms and Implementation", chapters 3 and 11).
#pragma once

namespace pbmpi::core {

/// Sine and cosine of an angle [rad]; within 2 units in the last place below 1e5 rad. NaN for a non-finite
/// angle.
double sine(double angle);
double cosine(double angle);
/// e^x within 2 units in the last place; 0 below -745, infinity above 709.8.
double exponential(double x);
/// The angle [rad] of the direction (x, y), from -pi to pi; within 8 units in the last place. 0 at the
/// origin.
double angle_of(double y, double x);

/// The angle [rad] of the direction (x, y), for x >= 0, in numbers or in lanes of numbers: T has their type
/// V, the type Scalar of a single number, broadcast(Scalar) and sqrt(V). Halving the angle four times leaves
/// a tangent below 0.1, for which the series of the arc tangent ends soon.
template <class T>
[[gnu::always_inline]] inline typename T::V angle_of_right_half(const typename T::V& y,
                                                                const typename T::V& x) {
  using V = typename T::V;
  using Scalar = typename T::Scalar;
  const V one = T::broadcast(1), length = T::sqrt(x * x + y * y) + x;
  V t = y / (length > V{} ? length : one);
  for (int halving = 0; halving < 3; ++halving) t = t / (one + T::sqrt(one + t * t));
  const V square = t * t;
  V series = T::broadcast(Scalar(1) / Scalar(17));
  for (int odd = 15; odd > 0; odd -= 2)
    series = T::broadcast(Scalar(1) / static_cast<Scalar>(odd)) - square * series;
  return T::broadcast(16) * t * series;
}

}  // namespace pbmpi::core
