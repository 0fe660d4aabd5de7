/// Which islands of a world sleep: the effect "sleeping".
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "model/contact.h"
#include "model/islands.h"
#include "model/state.h"

namespace pbmpi::effects {

/// A body that may sleep with others, and the lowest body among them.
struct Resting {
  int body = 0;
  int island = 0;
};

/// Two bodies in contact, either of which may be no_body.
using BodyPair = std::pair<int, int>;
std::vector<BodyPair> touching_bodies(std::span<const model::Contact> contacts);

/// The rule by which islands fall asleep and wake, over State::rest alone: what a world does next follows
/// from its state, whichever engine steps it.
///
/// A body rests while it stays near the pose at which it began to rest, within the rule's speeds times the
/// rule's time: its mean velocity counts, since iterative solvers make bodies tremble in place (a hand of a
/// standing human at 10 rad/s). Jolt Physics similarly checks that points stay within spheres; ODE's
/// auto-disable averages samples. An island of which all bodies have rested for the rule's time falls asleep
/// at the end of a step: its velocities become zero. Contacts between two sleeping bodies, or of a sleeping
/// body with the environment, are not looked for. An island wakes as a whole, in the step in which an awake
/// body touches it or an event concerns one of its bodies.
class Sleepers {
 public:
  /// `model` is borrowed. Steps take `dt_s`.
  Sleepers(const model::Model& model, double dt_s);

  /// Takes in a new state; a missing `rest` is filled in, with all bodies awake.
  void start(model::State& state);
  std::span<const int> awake() const { return awake_; }  ///< bodies, ascending

  /// The sleeping islands that an event of this step, or a release of the next, concerns. They are named by
  /// their lowest body, each once, ascending.
  std::vector<int> islands_called(std::int64_t step, const model::State& state) const;
  /// The sleeping islands that an awake body touches.
  static std::vector<int> islands_touched(std::span<const BodyPair> touching, const model::State& state);
  /// Wakes islands; true if there were any.
  bool wake(std::span<const int> islands, model::State& state);
  /// Wakes islands in a state that no engine has been given yet.
  static void wake_in(model::State& state, std::span<const int> islands);
  /// The sleeping islands of which a body has another pose or velocity in `after`.
  static std::vector<int> islands_moved(const model::State& before, const model::State& after);

  /// After a step: counts how long these awake bodies have rested.
  void count(std::span<const int> bodies, model::State& state) const;
  /// The bodies of islands that may fall asleep. `bodies`: awake ones, whole islands; `touching`: their
  /// contacts in the step.
  std::vector<Resting> find_resting(std::span<const int> bodies, std::span<const BodyPair> touching,
                                    const model::State& state);
  /// Joins what several find_resting() calls found, given the contacts between their bodies: an island may
  /// sleep if all its parts may. Ascending by body.
  static std::vector<Resting> join(int num_bodies, std::span<const Resting> resting,
                                   std::span<const BodyPair> touching);
  void put_to_sleep(std::span<const Resting> resting, model::State& state);

 private:
  void find_awake(const model::State& state);
  bool stays(const model::Rest& rest, const model::State& state, int body) const;

  const model::Model* model_;
  int steps_;            ///< how many steps an island rests before it sleeps
  double distance_m_;    ///< how far a body may be from where it began to rest
  double least_cosine_;  ///< cosine of half the angle by which it may be turned
  std::vector<int> awake_;
  model::DisjointSets sets_;
  std::vector<char> restless_;  ///< [num_bodies] scratch of find_resting(), set at an island's lowest body
};

}  // namespace pbmpi::effects
