/// The effect fast_bodies: speculative contacts for geoms that could pass through others between two steps,
/// and which bodies approach each other so fast that they need shorter steps.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "geometry/box.h"
#include "geometry/seams.h"
#include "geometry/swept_balls.h"
#include "model/contact.h"
#include "model/model.h"
#include "model/state.h"
#include "model/touch_rule.h"

namespace pbmpi::effects {

/// No geom of a body is fast in a step in which the body's centre of mass moves by at most way_m and the body
/// turns by at most turn_rad. A body without geoms has no bounds.
struct SlowBound {
  double way_m = 0, turn_rad = 0;
  bool holds(const core::Vec3& velocity, const core::Vec3& angular_velocity, double dt_s) const {
    return velocity.squaredNorm() * dt_s * dt_s <= way_m * way_m &&
           angular_velocity.squaredNorm() * dt_s * dt_s <= turn_rad * turn_rad;
  }
};
/// [num_bodies] No geom of a body within its bound moves by more than `most_approach_m` either.
std::vector<SlowBound> slow_bounds(const model::Model& model, double most_approach_m = model::infinity);

/// Finds speculative contacts of fast geoms. A geom is fast in a step if its centre moves further than half
/// its extent along its path: beyond that, collision detection at steps alone can find it behind the middle
/// of what it hits, or miss it.
///
/// The path of its centre in the step, extended by that half extent, is cast against each geom that it may
/// touch, relative to that geom if it is fast itself. Where the path enters the geom, a contact with a gap
/// (negative depth) keeps the two from coming closer than touching, with the friction and restitution of an
/// impact: none of its speed is left for a contact of the next step. A pair that already
/// touches gets one too, since a contact at the end of a rod turns the rod and lets its middle through. There
/// is none where a neighbour covers the surface (geometry::Seams), which the path has then entered first. A
/// pair's contact depends on nothing but the two geoms, so that a world cut into spaces finds the same
/// contacts.
///
/// An engine that can take shorter steps where they are needed also gets the approaches
/// (model::Contact::approach) of geoms whose centre moves by more than a given length: to geoms with whose
/// boxes theirs meet on the way, if the two come nearer to each other by more than that length. Other geoms
/// count as at rest, anywhere within that length. A body has one approach to each other body, and one to what
/// is static.
///
/// The engine that steps the world arms the pass by SlowBound, which costs next to nothing: a step in which
/// no geom can be fast is the same without the pass.
class FastBodies {
 public:
  /// False for a pair that another caller checks.
  using Filter = std::function<bool(int fast_geom, int other_geom)>;

  /// `model` is borrowed. Considers all bodies. An infinite `most_approach_m` finds no approaches.
  explicit FastBodies(const model::Model& model, double most_approach_m = model::infinity);

  /// From now on considers only these bodies, in any order, and static geoms, at a cost that does not depend
  /// on how many others there are.
  void choose(std::span<const int> bodies);

  /// Takes in which joints are broken from now on (State::broken_in).
  void set_broken(std::span<const std::int32_t> broken_in) { rule_ = model::TouchRule(*model_, broken_in); }

  /// Finds the geoms that are fast, or may approach others, at the start of a step of `dt_s`; true if there
  /// are any. In a step that is one of several `pieces`, geoms are fast that would be so in all of them.
  bool look(const model::State& state, double dt_s, int pieces = 1);
  /// Bodies that had a fast geom in the last look(), ascending.
  const std::vector<int>& bodies() const { return bodies_; }
  /// The box in which a body of the last look() may meet or approach others in the step.
  struct Reach {
    int body = 0;
    geometry::Box box;  ///< a body whose ball, at rest or swept along its way, stays outside gets no contact
  };
  std::vector<Reach> reaches(const model::State& state) const;  ///< at least one for each of these bodies
  /// Adds to `contacts`, in canonical order (sorted by Contact::geoms), the speculative contacts and the
  /// approaches of the last look()'s geoms with the geoms that `filter` accepts: at most one of each a pair,
  /// after the pair's touching contacts.
  void add(const model::State& state, const Filter& filter, std::vector<model::Contact>& contacts);
  /// Like add(), but only with geoms of bodies of other groups; `group_of_body` [num_bodies], from 0 on for
  /// the bodies considered.
  void add_across(const model::State& state, std::span<const int> group_of_body,
                  std::vector<model::Contact>& contacts);

 private:
  /// What is looked up of a geom, with a ball that holds it, centred at its body's centre of mass so that it
  /// need not be turned.
  struct Ball {
    int body = model::no_body;
    int family = 0;                          ///< geoms of one family never touch
    core::Vec3 centre = core::Vec3::Zero();  ///< used for static geoms only
    double radius = 0;                       ///< [m]
    double least_half = 0;                   ///< half the geom's least extent [m]
    double arm = 0;                          ///< distance of the geom from its body's centre of mass [m]
  };
  /// Current balls; those of fast geoms are swept along their paths.
  struct BallSet {
    geometry::SweptBalls swept;
    std::vector<int> geoms;  ///< whose ball each is
  };
  /// A geom that is fast in this step, or may approach others, or both.
  struct Moving {
    int geom = 0, family = 0;
    double radius = 0;     ///< of its ball [m]
    model::BodyPose pose;  ///< of the geom
    core::Vec3 way;        ///< displacement of its centre in this step [m], world frame
    core::Vec3 reach;      ///< from its centre to where its front ends up, relative to the world [m]
    bool is_fast = false, may_approach = false;
  };

  void clear_sets(std::size_t count);
  void put_ball(const model::State& state, int geom, BallSet& set) const;
  void join_found(std::vector<model::Contact>& contacts);
  /// `most_m`: how far a slow geom may move in the step.
  static bool is_slow(const Ball& ball, const core::Vec3& velocity, const core::Vec3& spin, double dt_s,
                      double most_m);
  /// The geom as moving; null if it is neither fast nor may approach another.
  const Moving* moving(int geom) const {
    const int index = moving_of_geom_[static_cast<std::size_t>(geom)];
    return index < 0 ? nullptr : &moving_[static_cast<std::size_t>(index)];
  }
  static bool is_near(const model::State& state, const core::Vec3& middle, double half_way, const Ball& ball);
  template <class Accepts>
  void look_from(const model::State& state, const Moving& from, const BallSet& set, const Accepts& accepts);
  template <class Accepts>
  void find_meetings(const model::State& state, const Moving& fast, const BallSet& set,
                     const Accepts& accepts);
  template <class Accepts>
  void find_approaches(const model::State& state, const Moving& from, const BallSet& set,
                       const Accepts& accepts);
  void meet(const model::State& state, const Moving& fast, const core::Vec3& way, int other);
  void approach(const model::State& state, const Moving& from, int other);
  /// Makes it a contact of these two; true if the body of the first becomes its first.
  bool put_geoms(int geom, int other, model::Contact& contact) const;
  bool is_covered(const model::State& state, int geom, const core::Vec3& point,
                  const core::Vec3& normal) const;
  /// The pose of a geom that a path may meet, computed once in each call of add() or add_across().
  const model::BodyPose& met_pose(const model::State& state, int geom);
  void forget_met();

  const model::Model* model_;
  model::TouchRule rule_;
  std::unique_ptr<const geometry::Seams> seams_;  ///< none where no geoms touch that keep together
  std::vector<Ball> balls_;                       ///< [geoms]
  std::vector<std::vector<int>> geoms_of_body_;   ///< [bodies] ascending
  std::vector<int> static_geoms_;                 ///< ascending
  std::vector<int> chosen_;                       ///< geoms that are considered, static ones too
  std::vector<double> ease_of_turning_;  ///< [bodies] one over the mean moment of inertia [1/(kg m^2)]
  double most_approach_m_;
  std::vector<Moving> moving_;       ///< ascending
  std::vector<int> moving_of_geom_;  ///< [geoms] index into moving_, or -1
  std::vector<int> bodies_;
  std::vector<std::optional<model::BodyPose>> met_poses_;  ///< [geoms] none: not computed yet
  std::vector<int> met_;                                   ///< moving geoms whose pose is in met_poses_
  std::vector<BallSet> sets_;  ///< scratch of add(), add_across(): one for each group
  std::vector<model::Contact> found_, approaches_;
};

}  // namespace pbmpi::effects
