/// Which islands of a world get more substeps than others, and stiffer springs, where a run names a sag.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/contact.h"
#include "model/model.h"
#include "model/state.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// A contact or joint of sor is a spring of a frequency w / 2 pi. Under a force F it gives by F d / w^2,
/// where d = J M^-1 J^T is the relative acceleration of its bodies under a force of 1 (SpringStep): by little
/// where each body carries bodies of its own mass, by much where light bodies carry heavy ones, or many. The
/// forces carried over into a step tell by how much, whatever springs the island had in the last step. An
/// island is loaded if a spring gives by more than the sag, and stays loaded down to an eighth of it, so that
/// an island near the limit is not pushed out and let down in turn: how far a spring is open tells whether
/// stiff or soft springs held the island. An island's substeps thus depend on nothing but its own state.
///
/// Joints that are solved exactly do not give at rest, but they open by about as much when they swing, since
/// a substep moves bodies along straight lines. They count like other joints.
class LoadedIslands {
 public:
  /// `model` is borrowed; adds_substeps(settings).
  LoadedIslands(const model::Model& model, const stepping::StepperSettings& settings);

  /// Appends at least one body of each loaded island of these bodies. `contacts` in canonical order, and
  /// `forces` [contacts] with which they start; `state`: poses of the bodies and forces of their joints;
  /// `broken_in`: State::broken_in.
  void find(std::span<const int> bodies, std::span<const model::Contact> contacts,
            std::span<const model::ContactForce> forces, std::span<const std::int32_t> broken_in,
            const model::State& state, std::vector<int>& loaded);

 private:
  /// [1/kg] Acceleration along the unit vector `along` of the body's point at `arm` from its centre, under a
  /// force of 1 there.
  double mobility(int body, const model::Vec3& arm, const model::Vec3& along,
                  const model::State& state) const;
  /// [1/(kg m)] Acceleration of the body's farthest point under a torque of 1 about the unit vector `about`.
  double turning_mobility(int body, const model::Vec3& about, const model::State& state) const;
  /// [rad/s^2] Angular acceleration of the body under a torque, world frame.
  model::Vec3 turned_by(int body, const model::Vec3& torque, const model::State& state) const;
  /// [m] By how much the spring of a contact or joint gives under the force that it carries.
  double give_of(const model::Contact& contact, const model::ContactForce& force,
                 const model::State& state) const;
  double give_of(const model::Joint& joint, const model::JointForce& force, const model::State& state) const;
  /// Does a spring that would give by `give`, and is open by `opened` [m], make its island loaded?
  bool is_loaded(double give, double opened) const;
  /// Does the spring give so little that its opening does not matter?
  bool is_little(double give) const { return give <= share_to_stay_loaded * sag_m_; }
  /// is_little() by upper bounds of F d that need no poses.
  bool gives_little(const model::ContactForce& force) const;
  bool gives_little(std::size_t joint, const model::JointForce& force) const;

  static constexpr double share_to_stay_loaded = 0.125;  ///< of the sag

  const model::Model* model_;
  double sag_m_;
  double contact_give_;                       ///< [s^2] 1 / w^2
  double place_give_, turn_give_;             ///< [s^2] 1 / w^2 of joints
  std::vector<model::Mat3> inverse_inertia_;  ///< [num_bodies] body frame
  std::vector<double> radius_m_;              ///< [num_bodies] about the centre of mass
  std::vector<double> most_mobility_;         ///< [num_bodies] largest mobility of a point within that radius
  struct JointBounds {
    double force, torque;  ///< largest F d of a force and a torque of 1
  };
  std::vector<JointBounds> joint_bounds_;  ///< [joints]
  std::vector<char> is_among_;             ///< [num_bodies] scratch
};

}  // namespace pbmpi::solver
