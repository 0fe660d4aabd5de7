/// MJCF's `<worldbody>`: the tree of bodies.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "scenes/mjcf/defaults.h"
#include "scenes/mjcf/servo_reader.h"

namespace pbmpi::scenes::mjcf {

/// What the rest of the file specifies about bodies.
struct Context {
  Compiler compiler;
  Option option;
  Defaults defaults;
  std::set<std::string> leave_out;
};

/// Reads the bodies below `<worldbody>` as links, parents before children; the geoms of the world itself are
/// a link without joints. Returns the joints.
std::vector<JointPlace> read_bodies(const xml::Element& worldbody, const Context& context,
                                    links::Mechanism& mechanism, xml::Notes& notes);

}  // namespace pbmpi::scenes::mjcf
