/// MJCF's `<geom>` and `<inertial>`.
#pragma once

#include "scenes/links/links.h"
#include "scenes/mjcf/settings/defaults.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::mjcf {

/// A geom, its mass, and whether it counts for the inertia of its body.
struct ReadGeom {
  std::optional<links::LinkGeom> geom;  ///< none: a mesh or an ellipsoid that touches nothing
  std::optional<MassProperties> mass;   ///< in the body's frame
  std::string unknown_mass;             ///< why the mass is not known, for a message; empty: it is
};

/// `attributes` include the defaults of the geom's class. A geom whose contype and conaffinity are both 0
/// touches nothing, but has mass. A mesh touches others with its convex hull.
ReadGeom read_geom(xml::Attributes attributes, const Context& context);

MassProperties read_inertial(const xml::Element& element, const Compiler& compiler,
                             const xml::LeaveOut& leave_out);

/// A body's mass properties after the changes that `<compiler>` asks for.
MassProperties adjusted(const MassProperties& mass, const Compiler& compiler);

}  // namespace pbmpi::scenes::mjcf
