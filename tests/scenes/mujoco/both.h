/// One model in MJCF, stepped by MuJoCo and by pbmpi.
#pragma once

#include <map>
#include <string>

#include "core/vector.h"
#include "stepping/stepper.h"

namespace pbmpi::scenes {

/// Centres of mass [m] of bodies by their names, world frame.
using Centres = std::map<std::string, core::Vec3>;

/// MuJoCo's named bodies after `seconds`, in steps of dt_s, which replaces the file's.
Centres by_mujoco(const std::string& mjcf, double dt_s, double seconds);

/// pbmpi's bodies after `seconds` with these settings, including their dt_s.
Centres by_pbmpi(const std::string& mjcf, const stepping::StepperSettings& settings, double seconds);

/// The largest distance [m] between a body's two positions, over the bodies that both have.
double largest_distance(const Centres& a, const Centres& b);

}  // namespace pbmpi::scenes
