#include "scenes/meshes/model_meshes.h"

#include <cmath>

#include "core/error.h"
#include "core/text.h"

namespace pbmpi::scenes {
namespace {

constexpr const char* unreadable_mark = "# unreadable: ";

core::Vec3 placed(const core::Vec3& point, const MeshPlacing& placing, const core::Mat3& turn) {
  return (turn * (point - placing.frame.position)).cwiseProduct(placing.scale);
}

/// The moments of what is turned, then stretched.
Enclosed placed(const Enclosed& one, const MeshPlacing& placing, const core::Mat3& turn) {
  const core::Mat3 stretch = core::Mat3(placing.scale.asDiagonal()) * turn;
  const double factor = std::abs(placing.scale.prod());
  return {factor * one.volume, placed(one.centre, placing, turn),
          factor * stretch * one.moments * stretch.transpose()};
}

}  // namespace

ModelMesh place_mesh(MeshPoints points, const MeshPlacing& placing, const std::string& where) {
  const core::Mat3 turn = placing.frame.orientation.to_eigen().toRotationMatrix().transpose();
  for (core::Vec3& point : points.points) point = placed(point, placing, turn);
  ModelMesh mesh;
  mesh.found = geometry::convex_hull(points.points, placing.most_vertices, where);
  if (points.enclosed) mesh.enclosed = placed(*points.enclosed, placing, turn);
  mesh.note = note_on(mesh.found, points.left_out_m * placing.scale.cwiseAbs().maxCoeff());
  return mesh;
}

MassProperties mass_of(const ModelMesh& mesh, std::optional<double> mass_kg, double density) {
  const model::Hull& hull = *mesh.found.hull;
  const double volume = mesh.enclosed ? mesh.enclosed->volume : hull.volume;
  const double mass = mass_kg.value_or(density * volume);
  if (!mesh.enclosed) return {mass, mesh.found.centre, mass / volume * hull.inertia};
  const core::Mat3& moments = mesh.enclosed->moments;
  return {mass, mesh.enclosed->centre, mass / volume * (moments.trace() * core::Mat3::Identity() - moments)};
}

std::string text_of_unreadable(const std::string& problem) { return unreadable_mark + problem; }

const std::string& text_of_mesh(const std::map<std::string, std::string>& texts, const std::string& name,
                                const std::string& where) {
  const auto found = texts.find(name);
  core::require_input(found != texts.end(),
                      where + ": there is no text of " + core::in_quotes(name) +
                          "; give the path of an STL or OBJ, or its text in [files] of a "
                          "TOML scene");
  if (found->second.starts_with(unreadable_mark))
    throw core::InputError(where + ": " + found->second.substr(std::string(unreadable_mark).size()));
  return found->second;
}

}  // namespace pbmpi::scenes
