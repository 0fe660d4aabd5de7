#include "model/space_map.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "model/islands.h"
#include "model/joint_traits.h"

namespace pbmpi::model {
namespace {

int num_rows(const Joint& joint) {
  int rows = traits_of(joint.kind).held_rows();
  for (const AxisMotor& motor : joint.motors) rows += motor.active() ? 1 : 0;
  return rows;
}

void find_units(const Model& model, SpaceMap& map) {
  std::vector<std::pair<int, int>> links;
  for (const Joint& joint : model.joints) links.emplace_back(joint.body_a, joint.body_b);
  Islands units = find_islands(model.num_bodies(), links);
  map.unit_of_body = std::move(units.of_body);
  map.bodies_of_unit.resize(static_cast<std::size_t>(units.count));
  map.rows_of_unit.assign(static_cast<std::size_t>(units.count), 0);
  for (int body = 0; body < model.num_bodies(); ++body)
    map.bodies_of_unit[map.unit_of_body[body]].push_back(body);
  for (const Joint& joint : model.joints) map.rows_of_unit[map.unit_of_body[joint.body_a]] += num_rows(joint);
}

void find_shapes(const Model& model, SpaceMap& map) {
  std::vector<int> num_joints(map.bodies_of_unit.size(), 0);
  for (const Joint& joint : model.joints) ++num_joints[map.unit_of_body[joint.body_a]];
  std::map<std::array<std::size_t, 3>, int> shapes;
  for (std::size_t unit = 0; unit < num_joints.size(); ++unit) {
    const std::array<std::size_t, 3> key = {map.bodies_of_unit[unit].size(),
                                            static_cast<std::size_t>(map.rows_of_unit[unit]),
                                            static_cast<std::size_t>(num_joints[unit])};
    map.shape_of_unit.push_back(shapes.emplace(key, static_cast<int>(shapes.size())).first->second);
  }
}

void find_spaces(const Model& model, SpaceMap& map) {
  const std::size_t num_spaces = model.spaces.size();
  std::vector<std::map<int, int>> geoms(map.bodies_of_unit.size());  // number by space, where there is any
  for (const Geom& geom : model.geoms) {
    if (geom.body != no_body) ++geoms[map.unit_of_body[geom.body]][geom.space];
  }
  map.units_of_space.resize(num_spaces);
  for (std::size_t unit = 0; unit < geoms.size(); ++unit) {
    const auto most = std::ranges::max_element(geoms[unit], {}, &std::pair<const int, int>::second);
    map.space_of_unit.push_back(most == geoms[unit].end() ? 0 : most->first);
    map.units_of_space[map.space_of_unit.back()].push_back(static_cast<int>(unit));
  }
  map.geoms_of_space.resize(num_spaces);
  for (std::size_t geom = 0; geom < model.geoms.size(); ++geom) {
    const int body = model.geoms[geom].body;
    if (body != no_body) map.geoms_of_space[map.space_of_body(body)].push_back(static_cast<int>(geom));
  }
}

}  // namespace

int SpaceMap::num_shapes() const {
  return shape_of_unit.empty() ? 0 : *std::max_element(shape_of_unit.begin(), shape_of_unit.end()) + 1;
}

SpaceMap make_space_map(const Model& model) {
  SpaceMap map;
  find_units(model, map);
  find_shapes(model, map);
  find_spaces(model, map);
  return map;
}

}  // namespace pbmpi::model
