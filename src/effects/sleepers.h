/// Which islands of a world sleep: the effect "sleeping".
#pragma once

#include <cstdint>
#include <functional>
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
  bool held = false;   ///< Does a joint or a contact hold it, or one of these others, to the environment?
  bool still = false;  ///< It has no velocity at all, and no weight.
};

/// Two bodies in contact, either of which may be no_body.
using BodyPair = std::pair<int, int>;
std::vector<BodyPair> touching_bodies(std::span<const model::Contact> contacts);

/// The rule by which islands fall asleep and wake, over State::rest alone: what a world does next follows
/// from its state, whichever engine steps it.
///
/// A body stays while it is near the pose at which it began to, within the rule's speeds times the rule's
/// time: its mean velocity counts, since iterative solvers make bodies tremble in place (a hand of a standing
/// human at 10 rad/s). Jolt Physics similarly checks that points stay within spheres; ODE's auto-disable
/// averages samples. But what begins to fall, or turns back, is slow for a while, too. A body rests if it has
/// stayed for the rule's time and is in balance: neither its mean velocity nor its mean acceleration in the
/// last half of that time (three poses, a quarter of the time apart) stands out from its trembling. They are
/// below a creep, or within three standard deviations of what steps that change its velocity at random, by as
/// much as its own do, make of a body at rest. A smooth motion has next to no such changes, and is seen
/// however slow it is. What sways a little about its place (the hands of that human) is in balance over four
/// times the rule's time, in the same sense, with the intervals of the short watch as steps.
///
/// An island falls asleep at the end of a step if all its bodies rest, none of its motors aims at a velocity,
/// and something holds it, by a joint or a contact, to the environment; without that it falls or drifts on,
/// unless it has neither weight nor velocities. Its velocities become zero. Contacts between two sleeping
/// bodies, or of a sleeping body with the environment, are not looked for. An island wakes as a whole, in the
/// step in which an awake body touches it or an event concerns one of its bodies.
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
  /// Does a motor of a joint aim at a velocity?
  using IsDriven = std::function<bool(int joint)>;
  /// The bodies of islands, or of parts of islands, all of which rest. `bodies`: awake ones; `touching`:
  /// their contacts in the step. What join() makes of them may fall asleep.
  std::vector<Resting> find_resting(std::span<const int> bodies, std::span<const BodyPair> touching,
                                    const IsDriven& is_driven, const model::State& state);
  /// Joins what several find_resting() calls found, given the contacts between their bodies, to islands that
  /// may fall asleep: those of which all parts rest, and which something holds. Ascending by body.
  static std::vector<Resting> join(int num_bodies, std::span<const Resting> resting,
                                   std::span<const BodyPair> touching);
  void put_to_sleep(std::span<const Resting> resting, model::State& state);

 private:
  void find_awake(const model::State& state);
  bool stays(const model::Rest& rest, const model::State& state, int body) const;
  bool is_in_balance(const model::MotionWatch& watch, int interval, double step_s,
                     const core::Pose& now) const;
  /// True if an interval has ended, whose pose is still to be kept.
  bool take_step(model::MotionWatch& watch, int interval, int enough, double step_s,
                 const core::Pose& now) const;
  void watch(model::Rest& rest, const model::State& state, int body) const;
  bool sways(const model::Rest& rest) const;
  bool rests(int body, const model::State& state) const;
  void find_islands(std::span<const BodyPair> touching, const model::State& state);

  const model::Model* model_;
  double dt_s_;
  int steps_;                            ///< how many steps an island rests before it sleeps
  int interval_;                         ///< of the short watch [steps], a quarter of these
  double distance_m_;                    ///< how far a body may be from where it began to rest
  double least_cosine_;                  ///< cosine of half the angle by which it may be turned
  std::vector<int> joints_with_motors_;  ///< at the start or by an event
  std::vector<int> awake_;
  model::DisjointSets sets_;
  std::vector<char> restless_, held_;  ///< [num_bodies] scratch of find_resting(), at an island's lowest body
};

}  // namespace pbmpi::effects
