/// MJCF's `<joint>` and `<freejoint>`.
#pragma once

#include "scenes/links/links.h"
#include "scenes/mjcf/compiler.h"
#include "scenes/xml/notes.h"

namespace pbmpi::scenes::mjcf {

/// A joint, and the value that it has at the start (`ref`) [rad] or [m], from which servos count.
struct ReadJoint {
  links::LinkJoint joint;
  double start = 0;
};

/// `attributes`: with the defaults of the joint's class; `name`: of a joint that has none.
ReadJoint read_joint(xml::Attributes attributes, const std::string& name, const Compiler& compiler,
                     const Option& option, xml::Notes& notes);

links::LinkJoint read_free_joint(const xml::Element& element, const std::string& name);

}  // namespace pbmpi::scenes::mjcf
