/// Articulations: sets of bodies that joints connect. Bodies of equal articulations lie side by side in
/// lanes, whichever world they belong to; a brick or a projectile is an articulation of one body without
/// joints.
#pragma once

#include <algorithm>
#include <compare>
#include <vector>

#include "model/model.h"

namespace pbmpi::solver {

/// What a joint's rows need in addition to poses. Frames: a = first body, b = second (the world's frame where
/// there is none).
struct JointTerms {
  model::Vec3 anchor_a, anchor_b;
  model::Vec3 axis1_a, axis1_b, axis2_b;  ///< axis 1 as seen from either body at the start, axis 2 from b
  model::Vec3 normal1_a;      ///< universal, hinge2: direction in a's frame from which angle 1 is measured
  model::Vec3 normal2_b;      ///< universal: direction in b's frame from which angle 2 is measured
  model::Quat relative;       ///< q_a^-1 q_b at the start: hinge, slider, fixed
  double cos0 = 0, sin0 = 1;  ///< hinge2: cosine, sine of the initial angle between the axes
  double stiffness = 0, damping = 0;  ///< hinge2: the suspension's [N/m], [N s/m]
};

/// One joint of an articulation, with its bodies by their indices in the articulation.
struct JointLink {
  model::JointKind kind = model::JointKind::ball;
  int body_a = 0;
  int body_b = 0;       ///< num_bodies = the static body
  bool sprung = false;  ///< hinge2 with a suspension spring
  bool rotor = false;   ///< an axis has an armature
  bool operator==(const JointLink&) const = default;
  auto operator<=>(const JointLink&) const = default;
};

/// What two articulations must have in common to lie in neighbouring lanes. Masses, lengths and angles may
/// differ.
struct ArticulationShape {
  int num_bodies = 0;
  std::vector<JointLink> joints;
  /// Does a joint act at the end of an arm so long, or join masses so different, that sweeps hardly contract
  /// its error? Single sweeps with a memory held each of 360 random trees of up to 8 bodies with arms up to 3
  /// radii of gyration and masses up to 30 to 1, and not all with 10 and 10,000. Humans have up to 10.5 times
  /// a centre's mobility at a joint, cars 60 times a wheel's mass. A slider without a stop at either end has
  /// arms that grow without bound.
  bool is_strained = false;
  /// Does a joint hold the articulation to the static body?
  bool hangs() const {
    return std::ranges::any_of(joints, [this](const JointLink& link) { return link.body_b == num_bodies; });
  }
  bool has_rotors() const { return std::ranges::any_of(joints, &JointLink::rotor); }
  bool operator==(const ArticulationShape&) const = default;
  auto operator<=>(const ArticulationShape&) const = default;
};

/// One articulation of one world.
struct Articulation {
  ArticulationShape shape;
  std::vector<int> bodies;        ///< [num_bodies] index of each in the model
  std::vector<int> joints;        ///< [joints] index of each in the model
  std::vector<JointTerms> terms;  ///< [joints]
};

/// The articulations of a model, in order of their lowest bodies.
std::vector<Articulation> find_articulations(const model::Model& model);

}  // namespace pbmpi::solver
