/// Which islands of a world get collision detection several times a step, and how it finds their contacts.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "effects/fast_bodies.h"
#include "geometry/box.h"
#include "geometry/box_tree.h"
#include "model/contact.h"
#include "model/model.h"
#include "model/state.h"
#include "model/touch_rule.h"
#include "solver/pack/pack.h"
#include "solver/parts/step_islands.h"
#include "stepping/stepper.h"

namespace pbmpi::solver {

/// Contacts that are found once a step serve all its substeps. Where bodies approach each other by far in a
/// step, they have overlapped by then before they are found, or hit at other places than they would: the
/// islands of such bodies, which approaches (model::Contact::approach) connect as contacts do, take the step
/// in pieces, each with contacts of its own: two, four or eight, so that a piece has no approach of more than
/// StepperSettings::approach_m if eight are enough.
///
/// An island's pieces thus depend on itself alone, and within the step its bodies meet only each other and
/// what is static.
class FineIslands {
 public:
  /// `model` is borrowed.
  FineIslands(const model::Model& model, const stepping::StepperSettings& settings);

  /// Can a world have a fine island under these settings?
  static bool can_be(const stepping::StepperSettings& settings);

  /// Finds the fine islands among these bodies, which make up whole islands. True if there are any.
  /// `contacts` in canonical order; `broken_in`: State::broken_in.
  bool find(std::span<const int> bodies, std::span<const model::Contact> contacts,
            std::span<const std::int32_t> broken_in, StepIslands& islands);
  /// After a find() that found any: the pieces into which the body's island cuts the step.
  int pieces(int body) const { return pieces_[static_cast<std::size_t>(body)]; }

  /// Sorts bodies of fine islands by island.
  void sort_by_island(std::vector<int>& bodies) const {
    std::ranges::stable_sort(bodies, {},
                             [this](int body) { return island_[static_cast<std::size_t>(body)]; });
  }
  /// At the start of a piece of `piece_s`: finds the contacts that these bodies, which are whole fine islands
  /// of the last find() and sorted by island, now have with others of their island and with what is static,
  /// in canonical order, and the speculative contacts of fast ones.
  void collide(Pack& pack, int world, std::span<const int> bodies, double piece_s,
               std::vector<model::Contact>& contacts);

 private:
  struct GeomBox {
    int geom = 0;
    geometry::Box box;
  };

  /// Puts the boxes of these bodies' geoms into boxes_.
  void put_boxes(std::span<const int> bodies);
  /// Adds the pairs of geoms of boxes_, with each other and with static ones.
  void find_pairs();
  void add_pair(int geom, int other);
  void add_fast(std::span<const int> bodies, double piece_s, std::vector<model::Contact>& contacts);
  bool together(int body, int other) const;

  const model::Model* model_;
  double most_approach_m_, margin_m_;
  std::vector<std::vector<int>> geoms_of_body_;
  /// A static plane: it holds what is below `height` along `normal`, world frame.
  struct Plane {
    int geom = 0;
    core::Vec3 normal;
    double height = 0;  ///< [m]
  };
  std::vector<int> static_geoms_;
  std::vector<Plane> planes_;
  geometry::BoxTree static_tree_;         ///< of static_geoms_
  std::vector<effects::SlowBound> slow_;  ///< [num_bodies]
  std::vector<std::int32_t> broken_in_;   ///< for which rule_ and fast_ hold
  model::TouchRule rule_;
  std::optional<effects::FastBodies> fast_;  ///< none before a body is fast in a piece
  std::vector<int> pieces_, island_;         ///< [num_bodies] an island is its lowest body
  // Scratch of collide().
  model::State state_;
  std::vector<GeomBox> boxes_;
  std::vector<model::GeomPair> pairs_;
};

}  // namespace pbmpi::solver
