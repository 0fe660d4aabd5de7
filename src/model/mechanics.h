/// Energy and momentum of a world, from its model and state.
#pragma once

#include <vector>

#include "model/model.h"
#include "model/state.h"

namespace pbmpi::model {

/// Energy and momentum of all bodies, summed in body order.
struct Mechanics {
  double energy_j = 0;                   ///< kinetic and potential: of bodies, body_energy(), and armatures
  Vec3 linear_momentum = Vec3::Zero();   ///< mass times velocity [kg m/s]
  Vec3 angular_momentum = Vec3::Zero();  ///< about the origin of the world frame [kg m^2/s]
};

/// Measures the states of one model, each in one pass over the bodies. The masses are stored contiguously:
/// fetching them from among the names and poses of a model would cost more than the sums themselves.
class MechanicsMeter {
 public:
  explicit MechanicsMeter(const Model& model);
  Mechanics measure(const State& state) const;

 private:
  struct Mass {
    double kg = 0;
    Mat3 inertia;  ///< [kg m^2], body frame
  };
  std::vector<Mass> masses_;   ///< [num_bodies]
  std::vector<Joint> rotors_;  ///< joints with an armature
  Vec3 gravity_;               ///< [m/s^2]
};

/// Kinetic and potential energy of one body [J]; the potential is measured from the world's origin, against
/// gravity.
double body_energy(const Model& model, const State& state, int index);

/// [rad/s] or [m/s] How fast the coordinate of axis 1 or 2 (index 0 or 1) of a joint changes. Where the axes
/// of a joint of two are not at right angles: the relative angular velocity along the axis.
double axis_speed(const State& state, const Joint& joint, int axis);

/// [num_bodies] For engines without armatures: the inertia of each body with that of the rotors whose joints
/// turn it, which then resist its own rotation instead of that against the joint's other body.
std::vector<Mat3> inertias_with_armatures(const Model& model);

/// The numbers of Mechanics, for single states.
double mechanical_energy(const Model& model, const State& state);
Vec3 linear_momentum(const Model& model, const State& state);
Vec3 angular_momentum(const Model& model, const State& state);

}  // namespace pbmpi::model
