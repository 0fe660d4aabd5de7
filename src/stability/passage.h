/// Detects bodies that passed through something.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/box_tree.h"
#include "model/contact.h"
#include "model/model.h"
#include "model/state.h"
#include "model/touch_rule.h"

namespace pbmpi::stability {

/// A body whose centre of mass is, or was, behind a geom that it may touch.
struct Passage {
  int body = 0;
  int through = 0;    ///< geom
  double beyond = 0;  ///< how far its centre is behind the plane, or went beyond the geom [m]; 0: inside it
};

/// Finds passages between two states of a world. A body is represented by its inner ball, the largest ball
/// about its centre of mass that fits into one of its geoms. Bodies whose centre lies in none of their geoms,
/// such as rings, are ignored, because others may pass through them.
///
/// A body has passed
/// - a static plane, if its centre has moved behind it by more than the body's size, from any point above:
///   hands and feet on which a car stands are pressed into the ground by half of their size;
/// - another static geom, if the straight path of its centre enters and leaves it, or ends in one that is
///   thinner than the inner ball, which then sticks out on both sides;
/// - a geom of another body, if that path, as seen from the other body, enters it, leaves it, and goes on for
///   twice the size of the body, which is then wholly behind it: light bodies that meet in a crash clip each
///   other's corners, and are pushed apart. A geom that turns meanwhile must be crossed both as it was turned
///   before and as it is turned after.
class PassageFinder {
 public:
  /// `model` is borrowed.
  explicit PassageFinder(const model::Model& model);

  /// Which bodies are tested against solid geoms: those that moved farther than their inner radius, so that
  /// slow worlds cost next to nothing, or all.
  enum class Pace { fast, any };

  /// The first passage, by body, between two states. `from` [num_bodies]: the start points of the centres [m,
  /// world frame], equal to before.position unless a launch has moved them.
  std::optional<Passage> find(const model::State& before, std::span<const model::Vec3> from,
                              const model::State& after, Pace pace = Pace::fast) const;

  /// [num_bodies] 1 where the body's centre lies in a solid geom that it may touch.
  std::vector<char> find_inside(const model::State& state) const;

 private:
  struct Mover {
    int body = 0;
    int geom = 0;       ///< geom that contains its centre
    double radius = 0;  ///< of the inner ball [m]
    double size = 0;    ///< of the body [m], see geometry::sizes_of()
  };
  struct Solid {
    int geom = 0;
    int body = model::no_body;
    model::Vec3 centre = model::Vec3::Zero();  ///< that of a static geom [m]
    double radius = 0;  ///< radius of the bounding ball about the body's centre of mass [m]
  };
  struct Plane {
    int geom = 0;
    model::Vec3 normal = model::Vec3::UnitZ();
    double height = 0;  ///< height of its points along the normal [m]
  };

  /// The data that decide which bodies can have passed through each other.
  struct Extent {
    double size = model::infinity;  ///< as Mover::size; infinite: not a mover
    double radius = 0;              ///< radius of the bounding ball of its geoms about the centre of mass [m]
    int actor = -1;  ///< whose geoms never touch each other; below 0: none, another for each body
    int first_solid = 0, last_solid = 0;  ///< range in moving_: [first, last)
    int mover = -1;                       ///< index into movers_; -1: none
  };
  struct Pair {
    int first = 0, second = 0;  ///< bodies
  };

  /// False if no body can have passed a static geom, judged by its position and after find_close_pairs().
  bool may_pass_static(const model::State& after, Pace pace) const;
  void find_close_pairs(std::span<const model::Vec3> from, const model::State& after) const;
  void find_close_to(int far) const;
  bool is_far(std::size_t body) const;
  bool is_inside(const model::State& state, const Mover& mover, const Solid& solid) const;
  std::optional<Passage> through_planes(const Mover& mover, const model::Vec3& from,
                                        const model::Vec3& to) const;
  std::optional<Passage> through_static(const Mover& mover, const model::Vec3& from,
                                        const model::Vec3& way) const;
  std::optional<Passage> through_body(int body, int other, const model::State& before,
                                      const model::State& after) const;

  const model::Model* model_;
  model::TouchRule rule_;
  std::vector<Mover> movers_;
  std::vector<Solid> static_, moving_;                                    ///< moving_: sorted by body
  std::vector<Extent> extents_;                                           ///< [num_bodies]
  double least_size_ = model::infinity, least_radius_ = model::infinity;  ///< smallest of movers_ [m]
  std::vector<Plane> planes_;
  geometry::BoxTree static_tree_;  ///< of static_
  // Results of the last call, kept as members to reuse their memory.
  mutable std::vector<model::Vec3> ways_;        ///< [num_bodies] paths of the centres
  mutable std::vector<double> squared_lengths_;  ///< [num_bodies] of ways_
  mutable std::vector<int>
      far_;  ///< bodies whose path differs from the mean by the size of the smallest mover
  mutable model::Vec3 mean_way_ = model::Vec3::Zero();  ///< [m] mean of ways_
  mutable std::vector<geometry::Box> reaches_;  ///< [num_bodies] boxes that hold each body along its path
  mutable geometry::BoxTree reach_tree_;        ///< of reaches_
  mutable std::vector<int> near_;               ///< of static_, those near a path
  mutable std::vector<Pair> close_;             ///< pairs that may have passed through each other
};

}  // namespace pbmpi::stability
