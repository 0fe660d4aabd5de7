/// Functions with which actors add bodies, geoms and joints to a model.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "model/model.h"

namespace pbmpi::scenes {

using core::Pose;
using core::Quat;
using core::Vec3;

/// The pose of `inner`, given in frame `outer`, in the frame in which `outer` is given.
Pose compose(const Pose& outer, const Pose& inner);

/// A rotation by `angle_rad` about a unit axis.
Quat rotation(double angle_rad, const Vec3& axis);

double radians(double degrees);

/// The step that begins nearest to `time_s`. Throws core::InputError beyond 2^53 steps: "`where`: ...".
std::int64_t step_at(double time_s, double dt_s, const std::string& where);

/// Appends an event. Throws std::length_error for a world's 4,000,001st.
void add_event(model::Model& model, const model::Event& event);

/// Appends an actor or a body, and returns its index. Throws std::length_error for the 4,000,001st body.
int add_actor(model::Model& model, std::string name, model::ActorKind kind);
int add_body(model::Model& model, model::Body body);

/// Joins two bodies, of which `b` may be model::no_body, by `joint`, whose anchor and axes are given in the
/// world frame at the initial poses; the anchors of the two bodies coincide. Axes need not have unit length.
void attach(const model::Model& model, int a, int b, const Vec3& anchor, const Vec3& axis1, const Vec3& axis2,
            model::Joint& joint);

/// A joint of that name and kind, attached.
model::Joint join(const model::Model& model, std::string name, model::JointKind kind, int a, int b,
                  const Vec3& anchor, const Vec3& axis1 = Vec3::UnitZ(), const Vec3& axis2 = Vec3::UnitX());

}  // namespace pbmpi::scenes
