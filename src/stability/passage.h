/// Bodies that went through something.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "model/contact.h"
#include "model/model.h"
#include "model/state.h"
#include "model/touch_rule.h"

namespace pbmpi::stability {

/// A body whose centre of mass is, or was, behind something that it may touch.
struct Passage {
  int body = 0;
  int through = 0;    ///< geom
  double beyond = 0;  ///< how far its centre is behind the plane, or went beyond the geom [m]; 0: it is in it
};

/// Finds passages between two states of a world. A body counts by its inner ball, the largest about its
/// centre of mass that one of its geoms holds; bodies whose centre lies in none of their geoms, such as
/// rings, are not looked at, because others may go through them.
///
/// A body has passed
/// - a static plane, if its centre has come behind it by more than the body's size, from whatever above that:
///   hands and feet on which a car stands are pressed into the ground by half of their size;
/// - another static geom, if the straight way of its centre comes in and leaves again, or ends in one that is
///   thinner than the inner ball, which then sticks out on both sides;
/// - a geom of another body, if that way as seen from it comes in, leaves again, and goes on by twice the
/// size
///   of the body, which is then wholly behind it: light bodies that meet in a crash clip each other's
///   corners, and are pushed apart. A geom that turns meanwhile must be crossed as it was turned before and
///   as it is after.
class PassageFinder {
 public:
  /// `model` is borrowed.
  explicit PassageFinder(const model::Model& model);

  /// Which bodies are tested for solid geoms: those that moved farther than their inner radius, so that slow
  /// worlds cost next to nothing, or all.
  enum class Pace { fast, any };

  /// The first passage, by body, between two states. `from` [num_bodies]: where the centres started [m, world
  /// frame], which is before.position unless a launch has put them elsewhere.
  std::optional<Passage> find(const model::State& before, std::span<const model::Vec3> from,
                              const model::State& after, Pace pace = Pace::fast) const;

  /// Does the body's centre lie in a solid geom that it may touch?
  bool is_inside(const model::State& state, int body) const;

 private:
  struct Mover {
    int body = 0;
    int geom = 0;       ///< that holds its centre
    double radius = 0;  ///< of the inner ball [m]
    double size = 0;    ///< of the body [m], see geometry::sizes_of()
  };
  struct Solid {
    int geom = 0;
    int body = model::no_body;
    model::Vec3 centre = model::Vec3::Zero();  ///< of a static geom [m]
    double radius = 0;  ///< of the ball that holds it, about the body's centre of mass [m]
  };
  struct Plane {
    int geom = 0;
    model::Vec3 normal = model::Vec3::UnitZ();
    double height = 0;  ///< of its points along the normal [m]
  };

  /// What decides which bodies can have gone through each other.
  struct Extent {
    double size = model::infinity;  ///< as Mover::size; infinite: it is no mover
    double radius = 0;              ///< of the ball about the centre of mass that holds its geoms [m]
    int actor = -1;  ///< whose geoms never touch each other; below 0: none, another for each body
    int first_solid = 0, last_solid = 0;  ///< in moving_: [first, last)
    int mover = -1;                       ///< in movers_; -1: none
  };
  struct Pair {
    int first = 0, second = 0;  ///< bodies
  };

  /// The balls that hold each body on its way, in single precision, so that all are compared with one at
  /// little cost.
  class Reaches {
   public:
    void set(std::span<const model::Vec3> position, std::span<const double> squared_lengths,
             std::span<const Extent> extents);
    /// [num_bodies] 1 where the ball meets that of `body`; until the next call.
    std::span<const std::int32_t> meeting(std::size_t body);

   private:
    std::vector<float> x_, y_, z_, radius_;
    std::vector<std::int32_t> hits_;
  };

  /// False if no body can have passed a static geom, by its place and after find_close_pairs().
  bool may_pass_static(const model::State& after, Pace pace) const;
  void find_close_pairs(std::span<const model::Vec3> from, const model::State& after) const;
  std::optional<Passage> through_planes(const Mover& mover, const model::Vec3& from,
                                        const model::Vec3& to) const;
  std::optional<Passage> through_static(const Mover& mover, const model::Vec3& from,
                                        const model::Vec3& way) const;
  std::optional<Passage> through_body(int body, int other, const model::State& before,
                                      const model::State& after) const;

  const model::Model* model_;
  model::TouchRule rule_;
  std::vector<Mover> movers_;
  std::vector<Solid> static_, moving_;                                    ///< moving_: by body
  std::vector<Extent> extents_;                                           ///< [num_bodies]
  double least_size_ = model::infinity, least_radius_ = model::infinity;  ///< of movers_ [m]
  std::vector<Plane> planes_;
  // Results of the last call, members so that they keep their memory.
  mutable std::vector<model::Vec3> ways_;        ///< [num_bodies] of the centres
  mutable std::vector<double> squared_lengths_;  ///< [num_bodies] of ways_
  mutable std::vector<int>
      far_;  ///< bodies whose way differs from the mean by the size of the smallest mover
  mutable Reaches reaches_;
  mutable std::vector<Pair> close_;  ///< that may have gone through each other
};

}  // namespace pbmpi::stability
