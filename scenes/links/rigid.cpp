#include "scenes/links/rigid.h"

#include <Eigen/Eigenvalues>

#include "core/error.h"
#include "core/text.h"
#include "scenes/links/massless.h"

namespace pbmpi::scenes::links {
namespace {

using model::Mat3;

/// Moves a link's mass and geoms into the rigid; `pose`: that of the link in the rigid's frame.
void take_over(const Link& link, int index, const Pose& pose, Rigid& rigid) {
  if (link.mass) rigid.mass = together(rigid.mass, moved(*link.mass, pose));
  if (rigid.odd_inertia.empty()) rigid.odd_inertia = link.odd_inertia;
  for (LinkGeom geom : link.geoms) {
    const bool stands_fast = geom.shape == model::Shape::plane || geom.shape == model::Shape::mesh;
    core::require_input(
        !stands_fast || rigid.joints.empty(),
        geom.where + ": a plane or a height field cannot move; put it into the world, or take a box");
    geom.pose = compose(pose, geom.pose);
    geom.link = index;
    rigid.geoms.push_back(std::move(geom));
  }
}

void require_masses(const std::vector<Rigid>& rigids) {
  std::string names, where;
  int count = 0;
  for (std::size_t i = 1; i < rigids.size(); ++i) {
    if (rigids[i].mass.mass_kg > 0) continue;
    if (where.empty()) where = rigids[i].where;
    names += (++count == 1 ? "" : ", ") + core::in_quotes(rigids[i].name);
  }
  core::require_input(count == 0, where + ": " + names + (count == 1 ? " moves but has" : " move but have") +
                                      " no mass; give an inertia, or geoms with a density");
}

void require_inertia(const Rigid& rigid) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(rigid.mass.inertia, Eigen::EigenvaluesOnly);
  core::require_input(eigen.eigenvalues().minCoeff() > 0,
                      rigid.where + ": " + core::in_quotes(rigid.name) +
                          " moves but its inertia is not positive definite; give it three positive moments");
  core::require_input(rigid.odd_inertia.empty() || is_of_a_body(rigid.mass.inertia), rigid.odd_inertia);
}

}  // namespace

MassProperties together(const MassProperties& a, const MassProperties& b) {
  const double mass = a.mass_kg + b.mass_kg;
  if (!(mass > 0)) return a;
  MassProperties sum{mass, (a.mass_kg * a.centre + b.mass_kg * b.centre) / mass, a.inertia + b.inertia};
  sum.inertia += steiner(a.mass_kg, a.centre - sum.centre) + steiner(b.mass_kg, b.centre - sum.centre);
  return sum;
}

MassProperties moved(const MassProperties& mass, const Pose& pose) {
  const Mat3 axes = pose.orientation.to_eigen().toRotationMatrix();
  return {mass.mass_kg, pose.point_to_outer(mass.centre), axes * mass.inertia * axes.transpose()};
}

RigidTree merge(const Mechanism& mechanism, xml::Notes& notes) {
  RigidTree tree;
  tree.rigids.emplace_back().name = "world";
  std::vector<Pose> in_rigid;  // of each link
  for (const Link& link : mechanism.links) {
    const auto parent = static_cast<std::size_t>(link.parent);
    const auto index = static_cast<int>(tree.rigid_of.size());
    const bool on_world = link.parent == no_link;
    const int above = on_world ? 0 : tree.rigid_of[parent];
    const Pose pose = on_world ? link.pose : compose(in_rigid[parent], link.pose);
    if (link.joints.empty()) {
      take_over(link, index, pose, tree.rigids[static_cast<std::size_t>(above)]);
      tree.rigid_of.push_back(above);
      in_rigid.push_back(pose);
      continue;
    }
    Rigid rigid;
    rigid.name = link.name;
    rigid.where = link.where;
    rigid.parent = above;
    rigid.pose = compose(tree.rigids[static_cast<std::size_t>(above)].pose, pose);
    rigid.joints = link.joints;
    take_over(link, index, {}, rigid);
    tree.rigid_of.push_back(static_cast<int>(tree.rigids.size()));
    in_rigid.push_back({});
    tree.rigids.push_back(std::move(rigid));
  }
  if (mechanism.joins_massless) join_massless(tree, notes);
  require_masses(tree.rigids);
  for (std::size_t i = 1; i < tree.rigids.size(); ++i) require_inertia(tree.rigids[i]);
  return tree;
}

}  // namespace pbmpi::scenes::links
