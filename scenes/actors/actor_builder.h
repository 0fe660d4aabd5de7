/// What builders of actors with several bodies have in common.
#pragma once

#include <array>
#include <string>
#include <utility>

#include "scenes/actors/actor.h"

namespace pbmpi::scenes {

/// Adds one actor to a model, part by part. Names of parts follow the actor's: "car.chassis".
class ActorBuilder {
 public:
  ActorBuilder(const Placement& place, model::ActorKind kind, model::Model& model)
      : place_(place), model_(model), actor_(add_actor(model, place.name, kind)) {}

 protected:
  /// A body with the actor's velocity, its mass centred at `pose` of the world; returns its index.
  int add_part(const std::string& name, double mass_kg, const model::Mat3& inertia, const Pose& pose) {
    model::Body body;
    body.name = place_.name + "." + name;
    body.actor = actor_;
    body.mass_kg = mass_kg;
    body.inertia = inertia;
    body.pose = pose;
    body.velocity = place_.velocity;
    return add_body(model_, std::move(body));
  }

  /// `local`: in the body's frame.
  void add_geom(int body, model::Shape shape, const std::array<double, 3>& size, const Pose& local,
                const model::Material& material) {
    model_.geoms.push_back({body, actor_, place_.space, shape, size, local, material});
  }

  /// Anchor and axes in the world frame. The reference holds until the next joint.
  model::Joint& add_joint(const std::string& name, model::JointKind kind, int inner, int outer,
                          const Vec3& anchor, const Vec3& axis1 = Vec3::UnitZ(),
                          const Vec3& axis2 = Vec3::UnitX()) {
    model_.joints.push_back(join(model_, place_.name + "." + name, kind, inner, outer, anchor, axis1, axis2));
    return model_.joints.back();
  }
  int last_joint() const { return model_.num_joints() - 1; }

  /// An event of a joint; the caller adds what it does.
  static model::Event event_of(model::EventKind kind, int joint, std::int64_t step) {
    model::Event event;
    event.kind = kind;
    event.joint = joint;
    event.step = step;
    return event;
  }

  Vec3 at(const Vec3& local) const { return place_.pose.point_to_outer(local); }
  Vec3 along(const Vec3& local) const { return place_.pose.direction_to_outer(local); }
  Vec3 forward() const { return along(Vec3::UnitX()); }
  Vec3 left() const { return along(Vec3::UnitY()); }
  Vec3 up() const { return along(Vec3::UnitZ()); }

  const Placement& place_;
  model::Model& model_;
  int actor_;
};

}  // namespace pbmpi::scenes
