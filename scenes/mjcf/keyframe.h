/// MJCF's `<keyframe>`: states from which a run may start.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/mjcf/places.h"
#include "scenes/xml/attributes.h"
#include "scenes/xml/leave_out.h"

namespace pbmpi::scenes::mjcf {

/// One `<key>`, or none: the places in the file, and controls of 0.
class Keyframe {
 public:
  Keyframe() = default;
  Keyframe(const xml::Element& key, const xml::LeaveOut& leave_out);

  /// Gives the joints, in the order of qpos, their starts, and free and mocap bodies their places. Throws
  /// core::InputError if the key has another number of values.
  void move(const Places& places, links::Mechanism& mechanism) const;
  /// Controls of the actuators, in their order. `are_copied`: does the model have copies of them, whose order
  /// is not known? Throws core::InputError then, or if the key has another number.
  std::vector<double> controls(std::size_t num_actuators, bool are_copied) const;

 private:
  void place_mocap(const std::vector<int>& links, links::Mechanism& mechanism) const;

  xml::Attributes attributes_{xml::Element{}};
  std::vector<double> qpos_, ctrl_, mpos_, mquat_;
};

/// The `<key>` called `name` in these `<keyframe>` sections; none if the name is empty, with a note on each
/// key from which nothing starts. Throws core::InputError for an unknown name.
Keyframe read_keyframe(const std::vector<const xml::Element*>& sections, const std::string& name,
                       const xml::LeaveOut& leave_out);

}  // namespace pbmpi::scenes::mjcf
