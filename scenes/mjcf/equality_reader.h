/// MJCF's `<equality>`: what holds two bodies together besides the tree's joints, or a joint in its place.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scenes/mjcf/places.h"

namespace pbmpi::scenes::mjcf {

/// Reads the elements of `<equality>`. The arguments are borrowed; all links are in their places in the file.
class EqualityReader {
 public:
  EqualityReader(const Places& places, links::Mechanism& mechanism);

  /// Adds closures to the mechanism, or a limit to a joint, unless the element is off. Throws
  /// core::InputError for what has no equal.
  void read(const xml::Element& element, const Part& part);

 private:
  /// A point or a frame of a link, in the link's frame.
  struct End {
    Named place;
    int link = 0;
    Pose frame;
  };
  std::vector<End> bodies(xml::Attributes& equality, const std::string& key, const Part& part);
  std::vector<End> sites(xml::Attributes& equality, const std::string& key, const Part& part);
  static std::optional<Pose> read_relative_pose(xml::Attributes& weld);
  void read_connection(xml::Attributes& equality, bool is_weld, const Part& part);
  void read_joint(xml::Attributes& equality, const Part& part);
  std::string unused_name(const End& first, const End& second);
  /// A frame of a link in the frame of another.
  Pose in_other(int link, const Pose& frame, int other) const;

  links::Mechanism& mechanism_;
  PlaceIndex<BodyPlace> body_index_;
  PlaceIndex<JointPlace> joint_index_;
  PlaceIndex<SitePlace> site_index_;
  std::set<std::string> names_;  ///< of joints and closures
  std::vector<Pose> poses_;      ///< [num_links] in the mechanism's frame
};

}  // namespace pbmpi::scenes::mjcf
