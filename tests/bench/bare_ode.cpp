#include "bare_ode.h"

#include <algorithm>
#include <cmath>

#include "ode/collide/broad_phase.h"
#include "ode/objects/bodies.h"
#include "ode/objects/joints.h"

namespace pbmpi::bench {
namespace {

constexpr int most_contacts = 8;

ode::SpaceHandle make_space(const model::Model& model) {
  return ode::SpaceHandle(ode::best_space(model.geoms.size()) == ode::SpaceKind::simple
                              ? dSimpleSpaceCreate(nullptr)
                              : dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ));
}

}  // namespace

class BareOde::World {
 public:
  World(const model::Model& model, double dt_s, int iterations)
      : model_(&model),
        world_(dWorldCreate()),
        bodies_(ode::make_bodies(world_.get(), model)),
        group_(dJointGroupCreate(0)),
        space_(make_space(model)),
        geoms_(model, bodies_, space_.get()) {
    dWorldSetGravity(world_.get(), model.gravity.x(), model.gravity.y(), model.gravity.z());
    dWorldSetERP(world_.get(), model.erp);
    dWorldSetCFM(world_.get(), model.cfm);
    dWorldSetQuickStepNumIterations(world_.get(), iterations);
    ode::make_joints(world_.get(), bodies_, model, dt_s);
  }

  void step(double dt_s) {
    num_contacts_ = 0;
    dSpaceCollide(space_.get(), this, near_callback);
    dWorldQuickStep(world_.get(), dt_s);
    dJointGroupEmpty(group_.get());
  }

  model::State state() const {
    model::State state;
    state.resize(model_->num_bodies());
    ode::copy_out(bodies_, state);
    return state;
  }
  int num_contacts() const { return num_contacts_; }

 private:
  static void near_callback(void* self, dGeomID a, dGeomID b) { static_cast<World*>(self)->collide(a, b); }

  void collide(dGeomID a, dGeomID b) {
    const dBodyID body_a = dGeomGetBody(a);
    const dBodyID body_b = dGeomGetBody(b);
    if (body_a != nullptr && body_b != nullptr && dAreConnectedExcluding(body_a, body_b, dJointTypeContact)) {
      return;
    }
    dContact contacts[most_contacts];
    const int most = std::min(most_contacts, model_->contact_law.max_per_pair);
    const int count = dCollide(a, b, most, &contacts[0].geom, sizeof(dContact));
    for (int i = 0; i < count; ++i) {
      set_surface(a, b, contacts[i].surface);
      dJointAttach(dJointCreateContact(world_.get(), group_.get(), &contacts[i]), body_a, body_b);
    }
    num_contacts_ += count;
  }

  void set_surface(dGeomID a, dGeomID b, dSurfaceParameters& surface) const {
    const model::Material& first = material_of(a);
    const model::Material& second = material_of(b);
    surface.mode = dContactSoftERP | dContactSoftCFM | dContactApprox1;
    surface.mu = std::sqrt(first.mu * second.mu);
    surface.soft_erp = model_->contact_law.soft_erp;
    surface.soft_cfm = model_->contact_law.soft_cfm;
    surface.bounce = std::max(first.restitution, second.restitution);
    surface.bounce_vel = model_->contact_law.bounce_velocity;
    if (surface.bounce > 0) surface.mode |= dContactBounce;
  }
  const model::Material& material_of(dGeomID geom) const {
    return model_->geoms[static_cast<const ode::GeomTag*>(dGeomGetData(geom))->index].material;
  }

  const model::Model* model_;
  ode::WorldHandle world_;
  std::vector<dBodyID> bodies_;
  ode::JointGroupHandle group_;
  ode::SpaceHandle space_;
  ode::Geoms geoms_;
  int num_contacts_ = 0;
};

BareOde::BareOde(const Models& models, double dt_s, int iterations) : dt_s_(dt_s) {
  for (const auto& model : models) worlds_.push_back(std::make_unique<World>(*model, dt_s, iterations));
}

BareOde::~BareOde() = default;

void BareOde::advance(int num_steps) {
  for (const auto& world : worlds_) {
    for (int i = 0; i < num_steps; ++i) world->step(dt_s_);
  }
}

model::State BareOde::state(int world) const { return worlds_[static_cast<std::size_t>(world)]->state(); }

int BareOde::num_contacts() const {
  int sum = 0;
  for (const auto& world : worlds_) sum += world->num_contacts();
  return sum;
}

}  // namespace pbmpi::bench
