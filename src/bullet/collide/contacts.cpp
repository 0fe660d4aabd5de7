#include "bullet/collide/contacts.h"

#include <algorithm>

namespace pbmpi::bullet {
namespace {

/// Represents an infinite friction coefficient: the friction limit is a product with the normal impulse,
/// which may be zero.
constexpr double no_slip = 1e6;

double depth(const btManifoldPoint& point) { return -point.getDistance(); }

/// Keeps only the deepest points of a pair.
void keep_deepest(btPersistentManifold& manifold, int most) {
  while (manifold.getNumContacts() > most) {
    int shallowest = 0;
    for (int i = 1; i < manifold.getNumContacts(); ++i) {
      if (depth(manifold.getContactPoint(i)) < depth(manifold.getContactPoint(shallowest))) shallowest = i;
    }
    manifold.removeContactPoint(shallowest);
  }
}

/// Keeps only touching points of surfaces that bounce: Bullet would subtract a gap from the speed at which
/// they separate.
void drop_gaps(btPersistentManifold& manifold) {
  for (int i = manifold.getNumContacts() - 1; i >= 0; --i) {
    if (depth(manifold.getContactPoint(i)) < 0) manifold.removeContactPoint(i);
  }
}

/// [m/s] speed at which the bodies of a manifold approach each other at a point.
double approach_speed(const btPersistentManifold& manifold, const btManifoldPoint& point) {
  const auto velocity = [](const btCollisionObject* object, const btVector3& at) {
    return btRigidBody::upcast(object)->getVelocityInLocalPoint(at - object->getWorldTransform().getOrigin());
  };
  return -point.m_normalWorldOnB.dot(velocity(manifold.getBody0(), point.getPositionWorldOnA()) -
                                     velocity(manifold.getBody1(), point.getPositionWorldOnB()));
}

model::Contact to_contact(const btManifoldPoint& point, const model::GeomPair& geoms,
                          const stepping::Touch& touch) {
  model::Contact contact;
  contact.body_a = touch.body_a;
  contact.body_b = touch.body_b;
  contact.position = 0.5 * (vec3(point.getPositionWorldOnA()) + vec3(point.getPositionWorldOnB()));
  contact.normal = vec3(point.m_normalWorldOnB);
  contact.depth = depth(point);
  contact.geoms = geoms;
  return contact;
}

}  // namespace

Contacts::Contacts(const model::Model& model, const effects::StepPlan& plan, const Shapes& shapes,
                   Bodies& bodies, Collider& collider, const btDispatcherInfo& info, double dt_s)
    : model_(&model),
      shapes_(&shapes),
      bodies_(&bodies),
      collider_(&collider),
      info_(&info),
      dt_s_(dt_s),
      friction_(plan.has(effects::EffectId::friction)),
      restitution_(plan.has(effects::EffectId::restitution)),
      most_points_(std::min(model.contact_law.max_per_pair, MANIFOLD_CACHE_SIZE)) {}

void Contacts::make(const std::vector<model::GeomPair>& pairs) {
  forget();
  for (const model::GeomPair& pair : pairs) collide(pair);
}

void Contacts::clear() {
  for (auto made = made_.rbegin(); made != made_.rend(); ++made)
    collider_->dispatcher().releaseManifold(made->manifold);
  made_.clear();
}

void Contacts::forget() {
  clear();
  touches_.clear();
  deepest_m_ = 0;
}

/// A manifold's normal points into its first body, which is the real one.
void Contacts::collide(const model::GeomPair& pair) {
  const auto body_of = [&](int geom) { return model_->geoms[static_cast<std::size_t>(geom)].body; };
  const bool swap = body_of(pair.first) == model::no_body;
  const int a = swap ? pair.second : pair.first, b = swap ? pair.first : pair.second;
  btPersistentManifold& manifold =
      *collider_->dispatcher().getNewManifold(&shapes_->body(a), &shapes_->body(b));
  manifold.setContactBreakingThreshold(std::min(shapes_->reach(a), shapes_->reach(b)));
  run(a, b, manifold);
  const model::Material material = surface_of(pair);
  if (material.restitution > 0) drop_gaps(manifold);
  if (manifold.getNumContacts() == 0) return collider_->dispatcher().releaseManifold(&manifold);
  keep_deepest(manifold, most_points_);
  keep(manifold, {body_of(a), body_of(b), manifold.getNumContacts(), model::contact_rows(material.mu)}, pair,
       material);
}

void Contacts::run(int a, int b, btPersistentManifold& manifold) {
  const btCollisionObjectWrapper first(nullptr, &shapes_->shape(a), &shapes_->body(a), shapes_->place(a), -1,
                                       -1);
  const btCollisionObjectWrapper second(nullptr, &shapes_->shape(b), &shapes_->body(b), shapes_->place(b), -1,
                                        -1);
  btManifoldResult result(&first, &second);
  result.setPersistentManifold(&manifold);
  collider_->collide(first, second, *info_, result);
}

void Contacts::keep(btPersistentManifold& manifold, const stepping::Touch& touch,
                    const model::GeomPair& geoms, const model::Material& material) {
  touches_.push_back(touch);
  made_.push_back({&manifold, geoms, material});
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    deepest_m_ = std::max(deepest_m_, depth(point));
    point.m_combinedFriction = material.mu;
    point.m_combinedRollingFriction = point.m_combinedSpinningFriction = 0;
    point.m_contactPointFlags |= BT_CONTACT_FLAG_HAS_CONTACT_CFM;
    point.m_contactCFM = model_->contact_law.soft_cfm;
    set_bounce(manifold, material.restitution, point);
  }
}

/// Bullet adds the bounce speed and the speed that pushes bodies apart; ODE takes the larger of the two.
void Contacts::set_bounce(const btPersistentManifold& manifold, double restitution,
                          btManifoldPoint& point) const {
  point.m_combinedRestitution = 0;
  if (restitution <= 0) return;
  const double speed = approach_speed(manifold, point);
  if (speed < model_->contact_law.bounce_velocity ||
      restitution * speed < model_->contact_law.soft_erp * depth(point) / dt_s_)
    return;
  point.m_combinedRestitution = restitution;
  point.m_contactPointFlags |= BT_CONTACT_FLAG_HAS_CONTACT_ERP;
  point.m_contactERP = 0;
}

/// Computed here, because Bullet would multiply the two bodies' coefficients.
model::Material Contacts::surface_of(const model::GeomPair& pair) const {
  model::Material material =
      model::pair_material(*model_, pair, model_->geoms[static_cast<std::size_t>(pair.first)].material,
                           model_->geoms[static_cast<std::size_t>(pair.second)].material);
  material.mu = friction_ ? std::min(material.mu, no_slip) : 0;
  if (!restitution_) material.restitution = 0;
  return material;
}

/// A point with a positive distance lets its bodies close that distance in a step, and no more. It has
/// neither friction nor restitution.
void Contacts::make_ahead(const std::vector<model::Contact>& contacts) {
  for (const model::Contact& contact : contacts) {
    btRigidBody &a = bodies_->get(contact.body_a), &b = bodies_->get(contact.body_b);
    const btVector3 between = to_bullet(contact.position), normal = to_bullet(contact.normal);
    const btVector3 to_b = 0.5 * contact.depth * normal, on_b = between + to_b, on_a = between - to_b;
    btManifoldPoint point(a.getWorldTransform().invXform(on_a), b.getWorldTransform().invXform(on_b), normal,
                          -contact.depth);
    point.m_positionWorldOnA = on_a;
    point.m_positionWorldOnB = on_b;
    btPersistentManifold& manifold = *collider_->dispatcher().getNewManifold(&a, &b);
    manifold.addManifoldPoint(point);
    touches_.push_back({contact.body_a, contact.body_b, 1, 1});
    made_.push_back({&manifold, contact.geoms, {0, 0}});
  }
}

void Contacts::show(std::span<const model::Vec3> before, std::vector<model::LoadedContact>& shown) const {
  for (std::size_t i = 0; i < made_.size(); ++i) {
    const btPersistentManifold& manifold = *made_[i].manifold;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& point = manifold.getContactPoint(k);
      model::Contact contact = to_contact(point, made_[i].geoms, touches_[i]);
      contact.mu = made_[i].material.mu;
      contact.restitution = made_[i].material.restitution;
      auto force = model::ContactForce::at(contact, before[static_cast<std::size_t>(contact.body_a)]);
      force.normal = point.m_appliedImpulse / dt_s_;
      force.friction = (point.m_appliedImpulseLateral1 * vec3(point.m_lateralFrictionDir1) +
                        point.m_appliedImpulseLateral2 * vec3(point.m_lateralFrictionDir2)) /
                       dt_s_;
      shown.push_back({contact, force});
    }
  }
}

}  // namespace pbmpi::bullet
