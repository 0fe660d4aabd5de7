/// Finds the pairs of geoms of one world that may touch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/box.h"
#include "geometry/box_tree.h"
#include "model/contact.h"
#include "model/model.h"
#include "model/touch_rule.h"
#include "solver/collide/awake_geoms.h"

namespace pbmpi::solver {

/// Tests the bounding boxes of some geoms against each other, and planes against bounding boxes.
///
/// Each geom has room in which its box may move; pairs whose rooms overlap are kept from step to step, and
/// tested in each by their boxes. Only a geom whose box leaves its room is looked up again among all others.
/// What is found depends on the boxes alone, since each room holds its geom's box.
class BroadPhase {
 public:
  /// `model` is borrowed; `geoms`: ascending; boxes and AwakeGeoms count along them.
  BroadPhase(const model::Model& model, std::span<const int> geoms);

  /// Takes in which joints are broken from now on (State::broken_in).
  void set_broken(std::span<const std::int32_t> broken_in);

  /// Appends the pairs (first < second, by geom index) whose boxes overlap, or of which one reaches below the
  /// other, a plane, sorted; if `awake` is given, only those with an awake geom. `boxes`: [geoms], [m] world
  /// frame; a plane's is not used, and one with a NaN is in no pair.
  void append_pairs(std::span<const geometry::Box> boxes, const AwakeGeoms* awake,
                    std::vector<model::GeomPair>& pairs);

 private:
  /// A static plane: its points have this height [m] along its normal.
  struct Plane {
    int index = 0;  ///< into geoms
    model::Vec3 normal = model::Vec3::UnitZ();
    double height = 0;
    bool reaches(const geometry::Box& box) const;
  };
  /// Two geoms, by their index into geoms, whose rooms overlap.
  struct Candidate {
    int first = 0, second = 0;
    int plane = -1;  ///< index into planes_ if one of them is a plane
    bool operator<(const Candidate& other) const {
      return first != other.first ? first < other.first : second < other.second;
    }
  };

  bool is_plane(int i) const { return plane_of_[at(i)] >= 0; }
  bool is_static(int i) const { return geom(i).body == model::no_body; }
  const model::Geom& geom(int i) const { return model_->geoms[at(geoms_[at(i)])]; }
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  void find_moved(std::span<const geometry::Box> boxes);
  void renew_candidates(std::span<const geometry::Box> boxes);
  void find_candidates_of(int moved);
  void add_candidate(int one, int other, int plane);
  bool overlap(const Candidate& candidate, std::span<const geometry::Box> boxes) const;

  const model::Model* model_;
  std::vector<int> geoms_;
  model::TouchRule rule_;
  std::vector<char> broken_;  ///< [joints] as rule_ takes them
  std::vector<Plane> planes_;
  std::vector<int> plane_of_;          ///< [geoms] index into planes_, or -1
  std::vector<geometry::Box> rooms_;   ///< [geoms] empty before the first call, and a plane's
  geometry::BoxTree tree_;             ///< of rooms_
  std::vector<Candidate> candidates_;  ///< sorted
  std::vector<Candidate> found_;       ///< those of the geoms that have moved
  std::vector<int> moved_;             ///< geoms whose box has left its room
  std::vector<char> has_moved_;        ///< [geoms]
};

}  // namespace pbmpi::solver
