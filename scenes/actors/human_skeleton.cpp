#include "scenes/actors/human_skeleton.h"

namespace pbmpi::scenes {

/// De Leva's lengths were measured on lying men, and the neck's endpoint is on the back; stacked on ankles
/// and legs they exceed the stature by 3 cm. The trunk's and the head's lengths are scaled down, so that the
/// stature is exact and the legs keep their lengths.
Skeleton::Skeleton(double stature_m) {
  scale = stature_m / mean_stature_m;
  ankle = ankle_height * stature_m;
  knee = ankle + shank.length_m * scale;
  hip = knee + thigh.length_m * scale;
  const double stacked = lower_trunk.length_m + middle_trunk.length_m + upper_trunk.length_m + head.length_m;
  trunk_scale = (stature_m - hip) / stacked;
  navel = hip + lower_trunk.length_m * trunk_scale;
  xiphoid = navel + middle_trunk.length_m * trunk_scale;
  neck = xiphoid + upper_trunk.length_m * trunk_scale;
  vertex = stature_m;
  shoulder = shoulder_height * stature_m;
  elbow = shoulder - upper_arm.length_m * scale;
  wrist = elbow - forearm.length_m * scale;
}

model::Mat3 segment_inertia(const Segment& segment, double mass_kg, double length_m, int longitudinal) {
  const auto moment = [&](double gyration) { return mass_kg * gyration * length_m * gyration * length_m; };
  const double sagittal = moment(segment.gyration_sagittal);
  const double transverse = moment(segment.gyration_transverse);
  const double along = moment(segment.gyration_longitudinal);
  const model::Vec3 diagonal =
      longitudinal == 0 ? model::Vec3(along, transverse, sagittal) : model::Vec3(sagittal, transverse, along);
  return diagonal.asDiagonal();
}

}  // namespace pbmpi::scenes
