/// Makes geoms from the model, and decides which pairs of them may touch.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/model.h"
#include "ode/objects/handles.h"

namespace pbmpi::ode {

/// The data of a geom for the broad phase; ODE's geom points to it (dGeomGetData).
struct GeomTag {
  int index = 0;  ///< into Model::geoms
  int body = model::no_body;
  int actor = 0;
  bool self_collision = false;  ///< of its actor
  bool is_plane = false;
  bool check_joined = false;  ///< its body has a joint to a body that it might otherwise touch
};

/// Bodies connected by a joint that holds: their geoms do not touch (model::TouchRule).
class JoinedBodies {
 public:
  /// `broken_in`: as in model::State.
  explicit JoinedBodies(const model::Model& model, std::span<const std::int32_t> broken_in = {});
  bool contains(int body_a, int body_b) const;
  bool has_any(int body) const { return !neighbours_[body].empty(); }

 private:
  std::vector<std::vector<int>> neighbours_;  ///< [num_bodies] sorted; without those of one actor whose
                                              ///< geoms do not touch each other anyway
};

/// The ODE geom of a shape; `space` null: in no space. A plane is placed in the world, the others at the
/// origin.
dGeomID make_shape(const model::Geom& geom, dSpaceID space);

/// The geoms of a model in one ODE space, and the rule which of them may touch:
/// not two static ones, not two of one body, not two of one actor without self_collision, not two of bodies
/// that share a joint that holds. ODE's category bits already keep most of these pairs out of the bounding
/// box tests.
class Geoms {
 public:
  /// `space` owns the ODE geoms, whose tags live here: nothing may collide in it once this object is gone.
  Geoms(const model::Model& model, const std::vector<dBodyID>& bodies, dSpaceID space);
  Geoms(const Geoms&) = delete;
  Geoms& operator=(const Geoms&) = delete;

  /// Takes in the joints that are broken from now on: State::broken_in.
  void set_broken(const model::Model& model, std::span<const std::int32_t> broken_in) {
    joined_ = JoinedBodies(model, broken_in);
  }
  bool may_touch(const GeomTag& a, const GeomTag& b) const;
  const std::vector<dGeomID>& ids() const { return ids_; }  ///< in the model's order

 private:
  JoinedBodies joined_;
  std::vector<GeomTag> tags_;
  std::vector<dGeomID> ids_;
};

}  // namespace pbmpi::ode
