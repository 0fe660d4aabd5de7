/// The numbers of a human body: segments, joints, and their sources.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "model/model.h"

namespace pbmpi::scenes {

/// One segment, or that of one side where it is paired. From de Leva, "Adjustments to Zatsiorsky-Seluyanov's
/// segment inertia parameters", J. Biomech. 29(9), 1996, table 4, men (mean stature 1.741 m, mean mass 73.0
/// kg).
struct Segment {
  std::string_view name;
  double mass_fraction;  ///< of the body's mass
  double length_m;       ///< between the endpoints, at the mean stature
  double com_fraction;  ///< fraction of the length from the upper (foot: rear) endpoint to the centre of mass
  /// Radii of gyration as fractions of the length, about the sagittal (front-back), transverse (left-right)
  /// and longitudinal axes.
  double gyration_sagittal, gyration_transverse, gyration_longitudinal;
};

inline constexpr double mean_stature_m = 1.741;

inline constexpr Segment head = {"head", 0.0694, 0.2429, 0.5002, 0.303, 0.315, 0.261};  // vertex to C7
inline constexpr Segment upper_trunk = {"upper_trunk", 0.1596, 0.2421, 0.5066,
                                        0.505,         0.320,  0.465};  // C7 to xiphoid process
inline constexpr Segment middle_trunk = {"middle_trunk", 0.1633, 0.2155, 0.4502,
                                         0.482,          0.383,  0.468};  // xiphoid process to navel
inline constexpr Segment lower_trunk = {"lower_trunk", 0.1117, 0.1457, 0.6115,
                                        0.615,         0.551,  0.587};  // navel to the middle of the hips
inline constexpr Segment upper_arm = {"upper_arm", 0.0271, 0.2817, 0.5772, 0.285, 0.269, 0.158};
inline constexpr Segment forearm = {"forearm", 0.0162, 0.2689, 0.4574, 0.276, 0.265, 0.121};
inline constexpr Segment hand = {"hand", 0.0061, 0.0862, 0.7900, 0.628, 0.513, 0.401};  // wrist to knuckle
inline constexpr Segment thigh = {"thigh", 0.1416, 0.4222, 0.4095, 0.329, 0.329, 0.149};
inline constexpr Segment shank = {"shank", 0.0433, 0.4340, 0.4459, 0.255, 0.249, 0.103};  // knee to malleolus
inline constexpr Segment foot = {"foot", 0.0137, 0.2581, 0.4415, 0.257, 0.245, 0.124};    // heel to toe tip

/// Shares of the stature (Drillis and Contini, Body Segment Parameters, 1966, as drawn in Winter,
/// Biomechanics and Motor Control of Human Movement, fig. 4.1).
inline constexpr double ankle_height = 0.039;
inline constexpr double shoulder_height = 0.818;
inline constexpr double half_shoulder_breadth = 0.129;
inline constexpr double hand_length = 0.108;
inline constexpr double foot_breadth = 0.055;
/// A chosen value: hip joint centres are about 0.17 m apart in men; legs hang straight down from them.
inline constexpr double half_hip_distance = 0.05;
/// A chosen fraction of the foot's length, from the heel. The line of gravity then meets the ground slightly
/// behind the middle of the foot, where a standing man drifts least to either side.
inline constexpr double ankle_from_heel = 0.3;

/// A body is about as dense as water; this density turns masses into sizes (Dempster 1955: limbs 1.05 to
/// 1.16, trunk with lungs 1.03 kg/l).
inline constexpr double tissue_density_kg_m3 = 1050;

/// The range of one axis of a joint, and the strength with which its muscles can hold it.
struct Motion {
  double low_deg = 0, high_deg = 0;  ///< of the lower (outer) segment against the upper (inner) one
  double torque_nm = 0;  ///< greatest voluntary torque, of the order of magnitude of the weaker direction

  /// This motion with its angles counted from a pose that is already bent by `start_deg`.
  constexpr Motion from(double start_deg) const {
    return {low_deg - start_deg, high_deg - start_deg, torque_nm};
  }
};

/// Ranges of motion: American Academy of Orthopaedic Surgeons, Joint Motion: Method of Measuring and
/// Recording, 1965. Positive: flexion; abduction (hip), to the left (neck, trunk), towards the thumb (wrist).
/// Torques, rounded: legs Anderson, Madigan and Nussbaum, J. Biomech. 40, 2007; arms Holzbaur et al., J.
/// Biomech. 40, 2007; neck Vasavada, Li and Delp, Spine 26, 2001; trunk about 250 N m in extension. Knees and
/// elbows extend 5 degrees beyond straight, as in most people: a motor that holds a pose needs play on both
/// sides of it.
inline constexpr Motion neck_bend = {-45, 45, 40};
inline constexpr Motion neck_tilt = {-45, 45, 40};
inline constexpr Motion trunk_bend = {-30, 80, 250};
inline constexpr Motion trunk_tilt = {-35, 35, 200};
inline constexpr Motion elbow_bend = {-5, 150, 60};
inline constexpr Motion wrist_bend = {-70, 80, 10};
inline constexpr Motion wrist_tilt = {-30, 20, 10};
inline constexpr Motion hip_bend = {-30, 120, 200};
inline constexpr Motion hip_tilt = {-30, 45, 120};
inline constexpr Motion knee_bend = {-5, 135, 180};
inline constexpr double ankle_dorsiflexion_deg = 20;

/// Heights above the sole, and lengths, of a man of the given stature [m].
struct Skeleton {
  explicit Skeleton(double stature_m);

  double scale;        ///< stature / mean stature
  double trunk_scale;  ///< scale of the trunk's and the head's lengths
  double ankle, knee, hip, navel, xiphoid, neck, vertex, shoulder, elbow, wrist;
};

/// Inertia [kg m^2] of a segment of this mass and length; `longitudinal` is the axis (0 = x, 2 = z) along
/// which the segment lies. The transverse axis is y.
model::Mat3 segment_inertia(const Segment& segment, double mass_kg, double length_m, int longitudinal);

}  // namespace pbmpi::scenes
