#include "ode/collide/contacts.h"

#include <algorithm>

#include "geometry/geometry.h"

namespace pbmpi::ode {
namespace {

constexpr int most_of_dcollide = 0xffff;  // its flags hold the count in 16 bits

void put(const model::Vec3& position, const model::Vec3& normal, double depth, dContactGeom& found) {
  for (int k = 0; k < 3; ++k) {
    found.pos[k] = real(position[k]);
    found.normal[k] = real(normal[k]);
  }
  found.depth = real(depth);
}

}  // namespace

Contacts::Contacts(const model::Model& model, const effects::StepPlan& plan,
                   const std::vector<dBodyID>& bodies)
    : model_(&model),
      bodies_(bodies),
      friction_(plan.has(effects::EffectId::friction)),
      restitution_(plan.has(effects::EffectId::restitution)),
      cross_space_(plan.has(effects::EffectId::cross_space)),
      joints_(dJointGroupCreate(0)),
      most_per_pair_(std::min(model.contact_law.max_per_pair, most_of_dcollide)),
      found_(static_cast<std::size_t>(most_per_pair_)),
      surfaces_(0, model.contact_law.max_per_pair),
      seams_(plan.has(effects::EffectId::collision) ? geometry::Seams::find(model) : nullptr) {
  contact_.surface.soft_erp = model.contact_law.soft_erp;
  contact_.surface.soft_cfm = model.contact_law.soft_cfm;
  contact_.surface.bounce_vel = model.contact_law.bounce_velocity;
}

model::Contact to_contact(const model::Model& model, const GeomPair& pair, const dContactGeom& found) {
  return geometry::contact_at(model, pair, vec3(found.normal), {vec3(found.pos), found.depth});
}

void Contacts::watch(dJointID joint, const model::Contact& contact) {
  if (!keeps_) return;
  kept_.push_back({contact, {}});
  if (!friction_) kept_.back().contact.mu = 0;
  dJointSetFeedback(joint, &kept_.back().feedback);
}

/// The feedback is the force on the joint's first real body: body a.
void Contacts::show(std::span<const model::Vec3> before, std::vector<model::LoadedContact>& shown) const {
  for (const Kept& kept : kept_) {
    const model::Contact& contact = kept.contact;
    auto force = model::ContactForce::at(contact, before[static_cast<std::size_t>(contact.body_a)]);
    const model::Vec3 whole = vec3(kept.feedback.f1);
    force.normal = whole.dot(contact.normal);
    force.friction = whole - force.normal * contact.normal;
    shown.push_back({contact, force});
  }
}

void Contacts::make(dWorldID world, const std::vector<GeomPair>& pairs, const std::vector<dGeomID>& geoms) {
  kept_.clear();
  touches_.clear();
  deepest_m_ = 0;
  for (const GeomPair& pair : pairs) {
    int num_contacts = collide(pair, geoms);
    if (seams_) num_contacts = correct_at_seams(pair, num_contacts);
    if (num_contacts > 0) join(world, pair, num_contacts);
  }
}

int Contacts::collide(const GeomPair& pair, const std::vector<dGeomID>& geoms) {
  if (geometry::has_surface(model_->geoms[pair.first], model_->geoms[pair.second]))
    return collide_surfaces(pair);
  return dCollide(geoms[pair.first], geoms[pair.second], most_per_pair_, found_.data(), sizeof(dContactGeom));
}

/// ODE's own colliders for convex shapes know neither capsules nor cylinders.
int Contacts::collide_surfaces(const GeomPair& pair) {
  const auto placed = [&](const model::Geom& geom) {
    return geometry::geom_pose(geom,
                               geom.body == model::no_body ? geometry::static_pose() : pose_of(geom.body));
  };
  const model::Geom &first = model_->geoms[pair.first], &second = model_->geoms[pair.second];
  const auto points = surfaces_.collide(first, placed(first), second, placed(second));
  found_.resize(std::max(found_.size(), points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    put(points[i].at.position, points[i].normal, points[i].at.depth, found_[i]);
  return static_cast<int>(points.size());
}

model::BodyPose Contacts::pose_of(int body) const {
  model::BodyPose pose;
  std::copy_n(dBodyGetPosition(bodies_[body]), 3, pose.position);
  const dReal* rotation = dBodyGetRotation(bodies_[body]);  // rows of four
  for (int row = 0; row < 3; ++row) std::copy_n(rotation + 4 * row, 3, pose.rotation + 3 * row);
  return pose;
}

/// Returns how many contacts are left. ODE's normals point into the first geom.
int Contacts::correct_at_seams(const GeomPair& pair, int num_contacts) {
  corrected_.clear();
  for (int i = 0; i < num_contacts; ++i) corrected_.push_back(to_contact(*model_, pair, found_[i]));
  constexpr double touching = 0;
  seams_->correct(
      0, touching, [&](int body) { return pose_of(body); }, corrected_);
  const bool swapped = model_->geoms[pair.first].body == model::no_body;
  for (std::size_t i = 0; i < corrected_.size(); ++i) {
    const model::Contact& contact = corrected_[i];
    put(contact.position, swapped ? model::Vec3(-contact.normal) : contact.normal, contact.depth, found_[i]);
  }
  return static_cast<int>(corrected_.size());
}

/// ODE takes no negative depth; instead the motion along the normal sets the lowest speed at which the bodies
/// separate. There is neither friction nor restitution: ODE would let the bodies bounce before they touch.
void Contacts::make_ahead(dWorldID world, const std::vector<model::Contact>& contacts, double dt_s) {
  contact_.surface.mode = dContactSoftERP | dContactSoftCFM | dContactMotionN;
  contact_.surface.mu = 0;
  for (model::Contact contact : contacts) {
    contact.mu = contact.restitution = 0;
    contact_.surface.motionN = contact.depth / dt_s;
    std::copy_n(contact.position.data(), 3, contact_.geom.pos);
    std::copy_n(contact.normal.data(), 3, contact_.geom.normal);
    contact_.geom.depth = 0;
    touches_.push_back({contact.body_a, contact.body_b, 1, 1, is_cross_space(contact.geoms)});
    const dJointID joint = dJointCreateContact(world, joints_.get(), &contact_);
    dJointAttach(joint, body_id(contact.body_a), body_id(contact.body_b));
    watch(joint, contact);
  }
}

bool Contacts::is_cross_space(const GeomPair& pair) const {
  const model::Geom& first = model_->geoms[pair.first];
  const model::Geom& second = model_->geoms[pair.second];
  return cross_space_ && first.body != model::no_body && second.body != model::no_body &&
         first.space != second.space;
}

void Contacts::join(dWorldID world, const GeomPair& pair, int num_contacts) {
  const int body_a = model_->geoms[pair.first].body;
  const int body_b = model_->geoms[pair.second].body;
  touches_.push_back({body_a, body_b, num_contacts, set_surface(pair), is_cross_space(pair)});
  for (int i = 0; i < num_contacts; ++i) {
    contact_.geom = found_[i];
    deepest_m_ = std::max<double>(deepest_m_, found_[i].depth);
    const dJointID joint = dJointCreateContact(world, joints_.get(), &contact_);
    dJointAttach(joint, body_id(body_a), body_id(body_b));
    if (keeps_) watch(joint, to_contact(*model_, pair, found_[i]));
  }
}

/// Returns the number of rows of a contact with this surface. With dContactApprox1 mu is Coulomb's
/// coefficient; without it ODE takes mu as a force [N]. An infinite mu (no slip) must not set the flag: ODE
/// would multiply it by a normal force of 0.
int Contacts::set_surface(const GeomPair& pair) {
  const model::Material material = model::pair_material(*model_, pair, model_->geoms[pair.first].material,
                                                        model_->geoms[pair.second].material);
  dSurfaceParameters& surface = contact_.surface;
  surface.mode = dContactSoftERP | dContactSoftCFM;
  surface.mu = friction_ ? material.mu : 0;
  if (surface.mu > 0 && surface.mu < model::infinity) surface.mode |= dContactApprox1;
  surface.bounce = material.restitution;
  if (restitution_) surface.mode |= dContactBounce;
  return model::contact_rows(surface.mu);
}

}  // namespace pbmpi::ode
