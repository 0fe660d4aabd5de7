/// Which islands of a world get all iterations: the effect "field_of_interest".
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "effects/sleepers.h"
#include "model/contact.h"
#include "model/islands.h"
#include "model/model.h"

namespace pbmpi::effects {

/// An application can focus on the area around its user (Yeh, Faloutsos, Reinman 2006, section 2.2): an
/// island of which any body's centre lies within the radius is inside, and is solved with all iterations of
/// the run; other islands get a few. The choice is made anew at the start of each step, from its poses and
/// contacts alone. It concerns whole islands, so that no row couples bodies inside and outside.
class FieldOfInterest {
 public:
  /// `iterations`: the run's. A model without an Interest has all its islands inside.
  FieldOfInterest(const model::Model& model, int iterations);

  /// Takes in which joints are broken from now on and connect no islands (State::broken_in). `model`: the
  /// same as in the constructor.
  void set_broken(const model::Model& model, std::span<const std::int32_t> broken_in);

  /// The body that it follows, whose position set_center() needs each step; or no_body.
  int follows() const { return interest_.follows; }
  void set_center(const core::Vec3& center) { interest_.center = center; }
  /// Sets the center to the position of the followed body, given the positions of all bodies.
  void look(std::span<const core::Vec3> position) {
    if (follows() != model::no_body) set_center(position[static_cast<std::size_t>(follows())]);
  }
  int iterations() const { return iterations_; }
  int outside_iterations() const { return std::min(iterations_, interest_.outside_iterations); }
  /// Approximate cost of an island outside, as a share of its cost inside.
  double outside_share() const;
  /// Is a body whose centre is there inside?
  bool is_near(const core::Vec3& position) const {
    return !((position - interest_.center).squaredNorm() > interest_.radius_m * interest_.radius_m);
  }

  /// Sorts these bodies, which are whole islands of joints and contacts.
  void sort(std::span<const int> bodies, std::span<const core::Vec3> position,
            std::span<const model::Contact> contacts);
  void sort(std::span<const int> bodies, std::span<const core::Vec3> position,
            std::span<const BodyPair> touching);
  /// Bodies of the last sort(), in the order in which they were given.
  std::span<const int> inside() const { return inside_; }
  std::span<const int> outside() const { return outside_; }
  /// Was the body sorted, and is its island inside?
  bool contains(int body) const { return inside_set_[static_cast<std::size_t>(body)] != 0; }
  int iterations_of(int body) const { return contains(body) ? iterations() : outside_iterations(); }

 private:
  template <class Links, class Pair>
  void sort_linked(std::span<const int> bodies, std::span<const core::Vec3> position, const Links& links,
                   Pair pair_of);

  model::Interest interest_;
  int iterations_;
  model::DisjointSets jointed_;   ///< bodies that whole joints connect
  model::DisjointSets islands_;   ///< islands of the last sort(), if it needed them
  std::vector<char> near_;        ///< [num_bodies] scratch, set at the lowest body of an island
  std::vector<char> inside_set_;  ///< [num_bodies]
  std::vector<int> inside_, outside_;
};

}  // namespace pbmpi::effects
