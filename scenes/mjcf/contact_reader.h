/// MJCF's `<contact>`: what touches, or does not, against the rule of types and affinities.
#pragma once

#include <map>
#include <utility>

#include "scenes/mjcf/places.h"

namespace pbmpi::scenes::mjcf {

/// Reads the elements of `<contact>`. The arguments are borrowed.
class ContactReader {
 public:
  ContactReader(const Places& places, links::Mechanism& mechanism);

  /// Keeps bodies apart, or lets two geoms touch. Throws core::InputError for a pair that cannot touch here.
  void read(const xml::Element& element, const Part& part);

 private:
  void read_exclude(const xml::Element& element, const Part& part);
  void read_pair(const xml::Element& element, const Part& part);
  void require_free_pair(const xml::Attributes& pair, int first, int second) const;
  void let_touch(const xml::Attributes& pair, const GeomPlace& first, const GeomPlace& second);
  int moving_link(int link) const;
  links::LinkGeom& geom_at(const GeomPlace& place);

  links::Mechanism& mechanism_;
  PlaceIndex<BodyPlace> bodies_;
  PlaceIndex<GeomPlace> geoms_;
  std::map<std::pair<int, int>, unsigned> types_;  ///< types that no other geom has, of first geoms of pairs
};

}  // namespace pbmpi::scenes::mjcf
