#include "core/elementary.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace pbmpi::core {
namespace {

/// pi / 2 in three parts, of which the first two have 33 bits: multiples of these by less than 2^20 are
/// exact.
constexpr double half_pi[3] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
/// ln 2 in two parts; multiples of the first by less than 2^11 are exact.
constexpr double ln_2[2] = {0x1.62e42feep-1, 0x1.a39ef35793c76p-33};

/// 1 - x / (first (first + 1)) (1 - x / ((first + 2) (first + 3)) (1 - ...)): the tail of the series of sine
/// and cosine.
double alternating_series(double x, int first, int num_terms) {
  double sum = 1;
  for (int i = num_terms - 1; i >= 0; --i) {
    const int k = first + 2 * i;
    sum = 1 - x / (k * (k + 1)) * sum;
  }
  return sum;
}

/// Plain numbers for angle_of_right_half().
struct Numbers {
  using V = double;
  using Scalar = double;
  static double broadcast(double number) { return number; }
  static double sqrt(double square) { return std::sqrt(square); }
};

/// An angle as quarter turns and a rest of at most an eighth of a turn.
struct Reduced {
  int quarter;        ///< modulo 4
  double rest, tail;  ///< the rest is their sum
};

Reduced reduce(double angle) {
  constexpr double most = 0x1p20;  // quarter turns
  if (!(std::abs(angle) < most)) angle = std::fmod(angle, 2 * std::numbers::pi);
  const double quarters = std::floor(angle * (2 / std::numbers::pi) + 0.5);
  const double first = angle - quarters * half_pi[0];
  const double second = quarters * half_pi[1], rest = first - second;
  const double lost = (first - rest) - second;
  const double tail = lost - quarters * half_pi[2];
  return {static_cast<int>(quarters - 4 * std::floor(quarters / 4)), rest + tail,
          (rest - (rest + tail)) + tail};
}

/// Sine and cosine of the rest of a reduced angle.
double sine_of(const Reduced& angle) {
  const double square = angle.rest * angle.rest;
  const double less = angle.rest * (square / 6 * alternating_series(square, 4, 7));
  return angle.rest - (less - angle.tail);
}
double cosine_of(const Reduced& angle) {
  const double square = angle.rest * angle.rest;
  const double less = square / 2 * alternating_series(square, 3, 8);
  return 1 - (less + angle.rest * angle.tail);
}

/// The sine of `angle` plus `quarters` quarter turns.
double sine_after(double angle, int quarters) {
  if (!std::isfinite(angle)) return std::numeric_limits<double>::quiet_NaN();
  const Reduced reduced = reduce(angle);
  switch ((reduced.quarter + quarters) % 4) {
    case 0:
      return sine_of(reduced);
    case 1:
      return cosine_of(reduced);
    case 2:
      return -sine_of(reduced);
    default:
      return -cosine_of(reduced);
  }
}

}  // namespace

double sine(double angle) { return sine_after(angle, 0); }
double cosine(double angle) { return sine_after(angle, 1); }

double exponential(double x) {
  if (std::isnan(x)) return x;
  if (x > 709.8) return std::numeric_limits<double>::infinity();
  if (x < -745.2) return 0;
  const double twos = std::floor(x / std::numbers::ln2 + 0.5);
  const double high = x - twos * ln_2[0], low = twos * ln_2[1];
  const double rest = high - low, tail = (high - rest) - low;
  constexpr int num_terms = 14;
  double sum = 1;  // of the series after 1, divided by the rest
  for (int n = num_terms; n > 1; --n) sum = 1 + rest / n * sum;
  return std::ldexp(1 + (rest * sum + tail), static_cast<int>(twos));
}

double angle_of(double y, double x) {
  const double scale = std::fmax(std::abs(x), std::abs(y));  // so that no square overflows or underflows
  if (scale == 0 || std::isnan(x) || std::isnan(y)) return scale == 0 ? 0 : x + y;
  const auto part = [&](double value) {
    return std::isinf(scale) ? (std::isinf(value) ? std::copysign(1.0, value) : 0) : value / scale;
  };
  const double to = part(y), along = std::abs(part(x));
  const double angle = angle_of_right_half<Numbers>(to, along);
  if (!(x < 0)) return angle;
  return y < 0 ? -std::numbers::pi - angle : std::numbers::pi - angle;
}

}  // namespace pbmpi::core
