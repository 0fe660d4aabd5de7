#include "scenes/mjcf/contact_reader.h"

#include <algorithm>

#include "core/text.h"

namespace pbmpi::scenes::mjcf {
namespace {

using xml::Attributes;

bool meet(const links::LinkGeom& a, const links::LinkGeom& b) {
  return (a.contype & b.conaffinity) != 0 || (b.contype & a.conaffinity) != 0;
}

}  // namespace

ContactReader::ContactReader(const Places& places, links::Mechanism& mechanism)
    : mechanism_(mechanism), bodies_(places.bodies, "body"), geoms_(places.geoms, "geom") {}

void ContactReader::read(const xml::Element& element, const Part& part) {
  if (element.name == "exclude")
    read_exclude(element, part);
  else if (part.context->leave_out.drops(element.name, element.where))
    return;
  else if (element.name == "pair")
    read_pair(element, part);
  else
    xml::refuse_element(element, "unknown element; <contact> has <exclude> and <pair>; take it out");
}

void ContactReader::read_exclude(const xml::Element& element, const Part& part) {
  Attributes exclude(element, part.context->leave_out);
  for (const BodyPlace* first : bodies_.find(exclude, "body1", part)) {
    for (const BodyPlace* second : bodies_.find(exclude, "body2", part)) {
      if (are_together(*first, *second)) mechanism_.apart.emplace_back(first->link, second->link);
    }
  }
  exclude.allow({"name", "class"});
  exclude.finish();
}

void ContactReader::read_pair(const xml::Element& element, const Part& part) {
  const Context& context = *part.context;
  Attributes pair(element, context.leave_out, context.defaults.of(element, ""));
  const std::vector<double> friction = pair.numbers("friction", 1, 5);
  const int condim = pair.integer("condim", 1, 3);
  for (const GeomPlace* first : geoms_.find(pair, "geom1", part)) {
    for (const GeomPlace* second : geoms_.find(pair, "geom2", part)) {
      if (!are_together(*first, *second)) continue;
      const double own = std::max(geom_at(*first).mu, geom_at(*second).mu);
      const double wanted = condim == 1 ? 0 : friction.empty() ? own : friction[0];
      if (wanted != own)
        pair.fail_unless_left_out(friction.empty() ? "condim" : "friction",
                                  "a pair has the larger friction of its geoms; give them the pair's");
      require_free_pair(pair, first->link, second->link);
      if (context.option.collides && !meet(geom_at(*first), geom_at(*second)))
        let_touch(pair, *first, *second);
    }
  }
  for (const char* name : {"solref", "solreffriction", "solimp", "margin", "gap"}) {
    if (pair.has(name))
      context.leave_out.notes().add(pair.where(name),
                                    core::in_quotes(name) + " of pairs is left out: contacts are pbmpi's");
  }
  pair.allow({"name", "class"});
  pair.finish();
}

/// MuJoCo's pairs touch whatever else is said of them.
void ContactReader::require_free_pair(const Attributes& pair, int first, int second) const {
  const int a = moving_link(first), b = moving_link(second);
  const auto hangs_on = [&](int link, int other) {
    const int parent = mechanism_.links[static_cast<std::size_t>(link)].parent;
    return other != 0 && parent != links::no_link && moving_link(parent) == other;
  };
  if (a == b || hangs_on(a, b) || hangs_on(b, a))
    pair.fail(
        "geoms of one body, or of bodies that a joint connects, never touch here; take the pair out, or " +
        xml::LeaveOut::advice("pair"));
  const auto is_pair = [&](const std::pair<int, int>& apart) {
    return std::minmax(apart.first, apart.second) == std::minmax(first, second);
  };
  if (std::ranges::any_of(mechanism_.apart, is_pair))
    pair.fail(
        "its bodies are kept apart by an <exclude>, which counts for all of their geoms here; leave out one");
}

/// Gives the first geom a type that no geom has yet, and the second the affinity to it.
void ContactReader::let_touch(const Attributes& pair, const GeomPlace& first, const GeomPlace& second) {
  unsigned& type = types_[{first.link, first.geom}];
  if (type == 0) {
    unsigned used = 0;
    for (const links::Link& link : mechanism_.links) {
      for (const links::LinkGeom& geom : link.geoms) used |= geom.contype | geom.conaffinity;
    }
    type = ~used & (used + 1);  // the lowest bit that is 0
    if (type == 0)
      pair.fail("no type of 32 is left for the first geom of the pair; join pairs, or take types out");
    geom_at(first).contype |= type;
  }
  geom_at(second).conaffinity |= type;
}

/// The link, or the first one above it with a joint; 0, the world, without one.
int ContactReader::moving_link(int link) const {
  while (link > 0 && mechanism_.links[static_cast<std::size_t>(link)].joints.empty())
    link = mechanism_.links[static_cast<std::size_t>(link)].parent;
  return link;
}

links::LinkGeom& ContactReader::geom_at(const GeomPlace& place) {
  return mechanism_.links[static_cast<std::size_t>(place.link)].geoms[static_cast<std::size_t>(place.geom)];
}

}  // namespace pbmpi::scenes::mjcf
