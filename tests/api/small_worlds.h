/// A small scene for tests of the library: falling balls, a door driven by a motor, a pendulum.
#pragma once

#include <string>

#include "pbmpi/batch.h"

namespace pbmpi::test {

/// Balls start at different places in each world and for each seed. Bodies: ball.1, ball.2, door, bob; motor:
/// hinge.
inline constexpr const char* small_scene = R"(
title = "balls, a door and a pendulum"
[run]
replicas = 3
[[actor]]
name = "ground"
type = "ground"
[[actor]]
name = "ball"
type = "sphere"
radius = 0.1
mass = 1
position = [3, 0, 0.3]
copies = 2
spacing = [0.25, 0, 0]
[actor.variation]
position = [0.01, 0.01, 0.05]
[[actor]]
name = "door"
type = "box"
size = [0.9, 0.05, 2]
mass = 30
position = [0.45, 0, 1.1]
[[actor]]
name = "bob"
type = "box"
size = [0.2, 0.2, 0.2]
mass = 2
position = [-2, 0, 1]
[[joint]]
name = "hinge"
kind = "hinge"
bodies = ["door", "world"]
anchor = [0, 0, 1.1]
axis = [0, 0, 1]
motor = { velocity = 0, max_force = 1000 }
[[joint]]
name = "pivot"
kind = "ball"
bodies = ["bob", "world"]
anchor = [-2.5, 0, 1]
)";

inline BatchOptions small_options(int num_worlds = 5, std::uint64_t seed = 1) {
  BatchOptions options;
  options.scene = "small";
  options.scene_text = small_scene;
  options.num_worlds = num_worlds;
  options.seed = seed;
  return options;
}

}  // namespace pbmpi::test
