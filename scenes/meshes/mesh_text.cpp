#include "scenes/meshes/mesh_text.h"

#include <algorithm>
#include <sstream>

#include "core/text.h"
#include "geometry/hulls/convex_hull.h"
#include "geometry/hulls/solid_integrals.h"

namespace pbmpi::scenes {
namespace {

constexpr const char* enclosed_mark = "# encloses ";
constexpr const char* left_out_mark = "# leaves out ";

/// Does each edge of a triangle have another one the other way? A triangle two of whose corners are one point
/// encloses nothing.
bool is_closed(const Mesh& mesh) {
  std::vector<std::pair<int, int>> ways, back;
  for (const auto& [a, b, c] : mesh.triangles) {
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      if (from == to) continue;
      ways.emplace_back(from, to);
      back.emplace_back(to, from);
    }
  }
  std::ranges::sort(ways);
  std::ranges::sort(back);
  return !ways.empty() && ways == back;
}

std::optional<Enclosed> enclosed_by(const Mesh& mesh) {
  if (!is_closed(mesh)) return std::nullopt;
  geometry::SolidIntegrals sum;
  const core::Vec3 origin = mesh.points.front();  // the numbers stay small
  const auto point = [&](int i) { return core::Vec3(mesh.points[static_cast<std::size_t>(i)] - origin); };
  for (const auto& [a, b, c] : mesh.triangles) sum.add(point(a), point(b), point(c));
  if (!(sum.volume() > 0)) return std::nullopt;
  const core::Mat3 inertia = sum.inertia_about_centre();
  return Enclosed{sum.volume(), sum.centre() + origin,
                  inertia.trace() / 2 * core::Mat3::Identity() - inertia};
}

std::string numbers(std::initializer_list<double> values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : " ") + core::number_text(value);
  return text;
}

}  // namespace

std::string mesh_text(const Mesh& mesh, const std::string& file) {
  const geometry::FoundHull found = geometry::convex_hull(mesh.points, geometry::most_hull_vertices, file);
  std::string text = "# the convex hull of " + std::to_string(mesh.points.size()) + " points\n";
  text += left_out_mark + core::number_text(found.left_out_m) + "\n";
  if (const auto enclosed = enclosed_by(mesh)) {
    const auto& [volume, c, m] = *enclosed;
    text += enclosed_mark +
            numbers({volume, c.x(), c.y(), c.z(), m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)}) +
            "\n";
  }
  for (const core::Vec3& vertex : found.hull->vertices) {
    const core::Vec3 at = vertex + found.centre;
    text += "v " + numbers({at.x(), at.y(), at.z()}) + "\n";
  }
  return text;
}

std::string surface_text(const Mesh& mesh) {
  std::string text = "# " + std::to_string(mesh.triangles.size()) + " triangles\n";
  for (const core::Vec3& at : mesh.points) text += "v " + numbers({at.x(), at.y(), at.z()}) + "\n";
  for (const auto& [a, b, c] : mesh.triangles)
    text += "f " + std::to_string(a + 1) + " " + std::to_string(b + 1) + " " + std::to_string(c + 1) + "\n";
  return text;
}

Mesh read_surface_text(const std::string& text, const std::string& file) {
  const bool is_obj = is_mesh_file(file) && (file.back() | 0x20) == 'j';  // also .OBJ
  return read_mesh(text, is_obj ? file : file + ".obj");
}

MeshPoints read_mesh_text(const std::string& text, const std::string& file) {
  const Mesh mesh = read_surface_text(text, file);
  MeshPoints read{mesh.points, enclosed_by(mesh), 0};
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("v")) break;
    if (line.starts_with(left_out_mark)) {
      std::istringstream(line.substr(std::string_view(left_out_mark).size())) >> read.left_out_m;
    } else if (line.starts_with(enclosed_mark)) {
      Enclosed e;
      std::istringstream values(line.substr(std::string_view(enclosed_mark).size()));
      core::Mat3& m = e.moments;
      values >> e.volume >> e.centre.x() >> e.centre.y() >> e.centre.z() >> m(0, 0) >> m(1, 1) >> m(2, 2) >>
          m(0, 1) >> m(0, 2) >> m(1, 2);
      m(1, 0) = m(0, 1);
      m(2, 0) = m(0, 2);
      m(2, 1) = m(1, 2);
      if (values) read.enclosed = e;
    }
  }
  return read;
}

}  // namespace pbmpi::scenes
