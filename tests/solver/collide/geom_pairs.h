/// Pairs of geoms for tests of collision detection.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "model/contact.h"
#include "model/model.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

struct ShapePair {
  model::Shape a, b;
};

/// Numbers in [0, 1), one after the other.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : seed_(seed) {}
  double operator()() { return static_cast<double>(core::mix_key(seed_, next_++, 0) >> 11) * 0x1.0p-53; }
  double between(double low, double high) { return low + (high - low) * (*this)(); }
  model::Vec3 in_cube(double half) {
    const double x = between(-half, half), y = between(-half, half), z = between(-half, half);
    return {x, y, z};
  }
  model::Quat rotation();

 private:
  std::uint64_t seed_, next_ = 0;
};

/// A geom of random size; `body` is no_body for a plane, which has a random pose.
model::Geom make_geom(model::Shape shape, int body, Dice& dice);

/// Two geoms of random sizes at the origin, each on a body of its own.
model::Model make_model(const ShapePair& shapes, Dice& dice);

/// `body` may be no_body.
model::Geom geom_of(model::Shape shape, int body, const std::array<double, 3>& size);

/// Contacts of two geoms at rest, the first one on a body at `pose`.
std::vector<model::Contact> contacts_of(const model::Geom& moving, const model::Pose& pose,
                                        const model::Geom& other,
                                        stepping::Precision precision = stepping::Precision::double_);

}  // namespace pbmpi::solver
