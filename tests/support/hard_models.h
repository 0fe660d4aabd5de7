/// Small models that blow up in ways that guards must detect.
#pragma once

#include "model/model.h"

namespace pbmpi::support {

/// `num_links` links of 0.2 m and 1 kg, level, attached to the world at one end, with `load_kg` at the other.
model::Model loaded_chain(int num_links, double load_kg);

/// `num_balls` elastic balls above elastic ground, dropped onto each other from 5 m.
model::Model elastic_balls(int num_balls);

/// Ten balls that fall from `height` [m] onto a static plate of 2 cm, 1 m above the ground. Nothing is fast
/// at the start.
model::Model balls_over_plate(double height);

/// A rod on a hinge that a motor of `torque` [N m] drives against a limit.
model::Model motor_at_limit(double torque);

/// Two cubes, one far inside the other, which their contacts throw apart; a third one rests next to them.
/// `offset` [m] moves all of them.
model::Model overlapping_cubes(double offset = 0);

}  // namespace pbmpi::support
