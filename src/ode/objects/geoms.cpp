#include "ode/objects/geoms.h"

#include <algorithm>

#include "core/error.h"
#include "model/state.h"

namespace pbmpi::ode {
namespace {

/// Category bits: one for all static geoms, one for all actors whose own geoms may touch, and one for each of
/// the first 30 other actors; the actors after these are separated by may_touch() alone.
constexpr unsigned long static_bit = 1ul << 0;
constexpr unsigned long open_bit = 1ul << 1;
constexpr unsigned long all_bits = 0xfffffffful;
constexpr int first_actor_bit = 2;
constexpr int num_bits = 32;

class CategoryBits {
 public:
  explicit CategoryBits(const model::Model& model) : of_actor_(model.actors.size(), open_bit) {
    int next = first_actor_bit;
    for (std::size_t i = 0; i < model.actors.size() && next < num_bits; ++i) {
      if (!model.actors[i].self_collision) of_actor_[i] = 1ul << next++;
    }
  }

  void apply(const model::Geom& geom, dGeomID id) const {
    const unsigned long bit = geom.body == model::no_body ? static_bit : of_actor_[geom.actor];
    dGeomSetCategoryBits(id, bit);
    dGeomSetCollideBits(id, bit == open_bit ? all_bits : all_bits & ~bit);
  }

 private:
  std::vector<unsigned long> of_actor_;
};

dGeomID make_plane(const model::Geom& geom, dSpaceID space) {
  const model::Vec3 normal = geom.local.direction_to_outer(model::Vec3::UnitZ());
  return dCreatePlane(space, normal.x(), normal.y(), normal.z(), normal.dot(geom.local.position));
}

/// An offset costs ODE a matrix product per step, so a geom centred on its body gets none.
void place(const model::Geom& geom, const std::vector<dBodyID>& bodies, dGeomID id) {
  const model::Vec3& position = geom.local.position;
  const model::Quat& orientation = geom.local.orientation;
  const dQuaternion q = {real(orientation.w), real(orientation.x), real(orientation.y), real(orientation.z)};
  if (geom.body == model::no_body) {
    if (geom.shape == model::Shape::plane) return;
    dGeomSetPosition(id, position.x(), position.y(), position.z());
    dGeomSetQuaternion(id, q);
    return;
  }
  dGeomSetBody(id, bodies[geom.body]);
  if (!position.isZero(0)) dGeomSetOffsetPosition(id, position.x(), position.y(), position.z());
  if (!(orientation == model::Quat{})) dGeomSetOffsetQuaternion(id, q);
}

}  // namespace

dGeomID make_shape(const model::Geom& geom, dSpaceID space) {
  const auto& size = geom.size;
  switch (geom.shape) {
    case model::Shape::sphere:
      return dCreateSphere(space, size[0]);
    case model::Shape::box:
      return dCreateBox(space, size[0], size[1], size[2]);
    case model::Shape::capsule:
      return dCreateCapsule(space, size[0], size[1]);
    case model::Shape::cylinder:
      return dCreateCylinder(space, size[0], size[1]);
    case model::Shape::plane:
      return make_plane(geom, space);
    case model::Shape::hull:  // for the broad phase alone: SurfaceContacts finds their contacts
    case model::Shape::mesh:
      return dCreateBox(space, size[0], size[1], size[2]);
  }
  throw std::logic_error("ode: a shape without a geom");
}

JoinedBodies::JoinedBodies(const model::Model& model, std::span<const std::int32_t> broken_in)
    : neighbours_(model.bodies.size()) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const model::Joint& joint = model.joints[i];
    if (joint.body_b == model::no_body || (!broken_in.empty() && broken_in[i] != model::unbroken)) continue;
    const int actor_a = model.bodies[joint.body_a].actor;
    const int actor_b = model.bodies[joint.body_b].actor;
    if (actor_a == actor_b && !model.actors[actor_a].self_collision) continue;
    neighbours_[joint.body_a].push_back(joint.body_b);
    neighbours_[joint.body_b].push_back(joint.body_a);
  }
  for (auto& list : neighbours_) std::sort(list.begin(), list.end());
}

bool JoinedBodies::contains(int body_a, int body_b) const {
  return std::binary_search(neighbours_[body_a].begin(), neighbours_[body_a].end(), body_b);
}

Geoms::Geoms(const model::Model& model, const std::vector<dBodyID>& bodies, dSpaceID space) : joined_(model) {
  const CategoryBits bits(model);
  tags_.reserve(model.geoms.size());  // ODE keeps pointers to the tags
  ids_.reserve(model.geoms.size());
  for (const model::Geom& geom : model.geoms) {
    const dGeomID id = make_shape(geom, space);
    place(geom, bodies, id);
    bits.apply(geom, id);
    tags_.push_back({static_cast<int>(tags_.size()), geom.body, geom.actor,
                     model.actors[geom.actor].self_collision, geom.shape == model::Shape::plane,
                     geom.body != model::no_body && joined_.has_any(geom.body)});
    dGeomSetData(id, &tags_.back());
    ids_.push_back(id);
  }
}

bool Geoms::may_touch(const GeomTag& a, const GeomTag& b) const {
  if (a.body == b.body) return false;
  if (a.actor == b.actor && !a.self_collision) return false;
  return !(a.check_joined && b.check_joined && joined_.contains(a.body, b.body));
}

}  // namespace pbmpi::ode
