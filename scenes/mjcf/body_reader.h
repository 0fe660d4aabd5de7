/// MJCF's `<worldbody>`: the tree of bodies.
#pragma once

#include <string>
#include <vector>

#include "scenes/mjcf/defaults.h"
#include "scenes/mjcf/servo_reader.h"

namespace pbmpi::scenes::mjcf {

/// Reads the bodies below all `<worldbody>` as links, parents before children; the geoms of the world itself
/// are a link without joints. Returns the joints in the order of MuJoCo's qpos.
std::vector<JointPlace> read_bodies(const std::vector<const xml::Element*>& worlds, const Context& context,
                                    links::Mechanism& mechanism);

}  // namespace pbmpi::scenes::mjcf
