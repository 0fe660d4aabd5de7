/// The state of a world whose pack moves some of its bodies, with a record, body by body, of which of the two
/// is newer.
#pragma once

#include <span>
#include <vector>

#include "geometry/geometry.h"
#include "model/state.h"
#include "solver/pack/pack.h"

namespace pbmpi::solver {

/// The state is authoritative. The pack has a body's state once it was loaded, until the state is changed
/// from elsewhere, or the body's lane was moved along with others.
class PackedState {
 public:
  /// Starts from the model's initial state; start() must follow.
  explicit PackedState(const model::Model& model);

  model::State& state() { return state_; }
  const model::State& state() const { return state_; }
  std::span<const model::BodyPose> poses() const { return poses_; }  ///< [num_bodies] of the state

  /// Begins with this state, rounded to the pack's number type. `pack` is new, and the world is its world 0.
  void start(const model::State& state, Pack& pack);

  /// `rows` as in stepping::SpaceStepper.
  void put_states(std::span<const int> bodies, std::span<const double> rows);
  /// Notes that the state's velocity of a body differs from the pack's.
  void touch(int body) { stale_[static_cast<std::size_t>(body)] = 1; }
  /// Launches through the pack and back, so that the numbers are rounded to the pack's number type.
  void launch(const model::Event& event, Pack& pack);

  /// Lets the pack collide at the poses of the state: loads bodies that are newer in the state, although they
  /// are not to move.
  void lend(std::span<const int> bodies, Pack& pack);
  /// Makes only `bodies` active from now on: the lanes of others may be moved along with their neighbours'.
  void activate(std::span<const int> bodies);
  /// Before a step of the active bodies.
  void load(std::span<const int> bodies, Pack& pack);
  /// After a step of the active bodies. `others_stay`: the pack puts back bodies that moved along.
  void store(std::span<const int> bodies, const Pack& pack, bool others_stay);

 private:
  /// Notes that the state of these bodies has come from elsewhere.
  void take_in(std::span<const int> bodies);
  void place(int body);
  void load_stale(std::span<const int> bodies, Pack& pack);

  model::State state_;
  std::vector<model::BodyPose> poses_;
  std::vector<char> stale_;  ///< [num_bodies] is the state newer than the pack?
  std::vector<int> lent_;    ///< bodies lent since the last store()
  std::vector<int> loaded_;  ///< bodies of the last load_stale()
};

}  // namespace pbmpi::solver
