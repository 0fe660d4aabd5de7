/// The state of a world whose pack moves some of its bodies: which of the two is newer, body by body.
#pragma once

#include <span>
#include <vector>

#include "geometry/geometry.h"
#include "model/state.h"
#include "solver/pack/pack.h"

namespace pbmpi::solver {

/// The state is what counts. The pack has a body's once it was loaded, until something else is put into the
/// state, or the body's lane was moved along with others.
class PackedState {
 public:
  /// As the model starts; start() has to follow.
  explicit PackedState(const model::Model& model);

  model::State& state() { return state_; }
  const model::State& state() const { return state_; }
  std::span<const model::BodyPose> poses() const { return poses_; }  ///< [num_bodies] of the state

  /// Begins with this state, rounded as the pack's number type has it. `pack` is new, its world 0.
  void start(const model::State& state, Pack& pack);

  /// `rows` as in stepping::SpaceStepper.
  void put_states(std::span<const int> bodies, std::span<const double> rows);
  /// Velocities stay as they are, or become zero.
  enum class Velocity { kept, zero };
  void put_poses(std::span<const int> bodies, std::span<const double> rows, Velocity velocity);
  /// The state has another velocity than the pack knows.
  void touch(int body) { stale_[static_cast<std::size_t>(body)] = 1; }
  /// Through the pack and back, so that the numbers are rounded as the pack has them.
  void launch(const model::Event& event, Pack& pack);

  /// The pack collides at the poses of the state: what is newer here is loaded, though it is not to move.
  void lend(std::span<const int> bodies, Pack& pack);
  /// Only `bodies` are active from now on: the lanes of others may be moved along with their neighbours'.
  void activate(std::span<const int> bodies);
  /// Before a step of the active bodies.
  void load(std::span<const int> bodies, Pack& pack);
  /// After it. `others_stay`: the pack puts back what moved along.
  void store(std::span<const int> bodies, const Pack& pack, bool others_stay);

 private:
  void put_pose(int body, const double* row);
  void place(int body);
  void load_stale(std::span<const int> bodies, Pack& pack);

  model::State state_;
  std::vector<model::BodyPose> poses_;
  std::vector<char> stale_;  ///< [num_bodies] the state is newer than the pack
  std::vector<int> lent_;    ///< since the last store()
  std::vector<int> loaded_;  ///< of the last load_stale()
};

}  // namespace pbmpi::solver
