/// Fills the lanes of a pack that no body and no joint uses.
#pragma once

#include "solver/joints/joint_batches.h"
#include "solver/layout/lane_places.h"

namespace pbmpi::solver {

/// Makes the idle lanes of a shape's last batch repeat lane 0, so that they compute something harmless.
template <class T>
void fill_idle_lanes(const LanePlaces& places, BodyLanes<T>& bodies, JointBatches<T>& joints) {
  using V = typename T::V;
  const auto repeat = [](auto& lanes, int from) {
    auto* values = reinterpret_cast<V*>(&lanes);
    for (std::size_t i = 0; i < sizeof lanes / sizeof(V); ++i) {
      for (int lane = from; lane < T::num_lanes; ++lane) T::set(values[i], lane, T::get(values[i], 0));
    }
  };
  for (int slot = 0; slot < places.num_slots(); ++slot) {
    repeat(bodies.bodies[slot], places.num_used(slot));
    repeat(bodies.twists[slot], places.num_used(slot));
  }
  for (int shape = 0; shape < joints.num_shapes(); ++shape) {
    for (JointLane<V>& joint : joints.joints(shape)) {
      const int from = places.num_used(joint.slot_a);
      repeat(joint.terms, from);
      repeat(joint.holds, from);
      for (AxisControl<V>& control : joint.controls) {
        for (V* v : {&control.low, &control.high, &control.sin_middle, &control.cos_middle, &control.middle,
                     &control.counts, &control.velocity, &control.max_force, &control.hold_rate,
                     &control.armature}) {
          repeat(*v, from);
        }
      }
    }
  }
}

}  // namespace pbmpi::solver
