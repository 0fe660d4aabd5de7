/// Random worlds, each from a number.
#pragma once

#include <cstdint>
#include <string>

#include "core/random.h"
#include "model/model.h"
#include "stepping/stepper.h"

namespace pbmpi::stability {

/// Numbers of one seed, one after the other.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}

  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Uniform in the logarithm.
  double scale(double low, double high);
  int below(int count) { return static_cast<int>(unit() * count); }
  bool chance(double probability) { return unit() < probability; }
  model::Vec3 direction();
  model::Vec3 in_box(double half) {
    const double x = between(-half, half), y = between(-half, half);
    return {x, y, between(-half, half)};
  }

 private:
  double unit() { return core::to_unit(core::mix_key(seed_, 0x66757a7a, next_++)); }

  std::uint64_t seed_, next_ = 0;
};

/// 1 to 20 bodies of all shapes, 1e-2 to 1e2 kg each, up to 200 m/s fast, with random overlaps; joints of all
/// kinds with limits, motors, suspensions and strengths; launches, motors and releases.
model::Model random_model(std::uint64_t seed);

/// A scene file with actors of all types at random places, headings and speeds.
std::string random_scene(std::uint64_t seed);

/// Steps of 1 to 50 ms, few to many iterations, substeps.
stepping::StepperSettings random_settings(std::uint64_t seed, stepping::StepperKind kind);

}  // namespace pbmpi::stability
