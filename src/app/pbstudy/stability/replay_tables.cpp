#include "app/pbstudy/stability/stability_table.h"
#include "app/pbstudy/study/table_columns.h"
#include "model/names.h"

namespace pbmpi::app {
namespace {

struct BodyOfScene {
  const SceneModel& scene;
  const model::Body& body;
};

struct GeomOfScene {
  const SceneModel& scene;
  const model::Geom& geom;

  std::string kind() const {
    return std::string(name_of(scene.model->actors[static_cast<std::size_t>(geom.actor)].kind));
  }
};

/// Position [m], orientation (w, x, y, z).
void append(const model::Pose& pose, std::vector<double>& numbers) {
  const model::Vec3& at = pose.position;
  const model::Quat& turn = pose.orientation;
  numbers.insert(numbers.end(), {at.x(), at.y(), at.z(), turn.w, turn.x, turn.y, turn.z});
}

std::vector<io::TableColumn> body_columns(const std::vector<BodyOfScene>& bodies) {
  using Row = const BodyOfScene&;
  std::vector<double> poses;
  for (Row row : bodies) append(row.body.pose, poses);
  return {column("scene", "", bodies, [](Row row) { return row.scene.name; }),
          column("name", "", bodies, [](Row row) { return row.body.name; }),
          {"pose", "", std::move(poses), 7}};
}

std::vector<io::TableColumn> geom_columns(const std::vector<GeomOfScene>& geoms) {
  using Row = const GeomOfScene&;
  std::vector<double> sizes, poses;
  for (Row row : geoms) {
    sizes.insert(sizes.end(), row.geom.size.begin(), row.geom.size.end());
    append(row.geom.local, poses);
  }
  return {column("scene", "", geoms, [](Row row) { return row.scene.name; }),
          column("body", "", geoms, [](Row row) { return row.geom.body; }),
          column("kind", "", geoms, [](Row row) { return row.kind(); }),
          column("shape", "", geoms, [](Row row) { return std::string(name_of(row.geom.shape)); }),
          {"size", "m", std::move(sizes), 3},
          {"local", "", std::move(poses), 7}};
}

}  // namespace

std::map<std::string, std::vector<io::TableColumn>> replay_tables(const std::vector<SceneModel>& scenes) {
  std::vector<BodyOfScene> bodies;
  std::vector<GeomOfScene> geoms;
  for (const SceneModel& scene : scenes) {
    for (const model::Body& body : scene.model->bodies) bodies.push_back({scene, body});
    for (const model::Geom& geom : scene.model->geoms) geoms.push_back({scene, geom});
  }
  return {{"bodies", body_columns(bodies)}, {"geoms", geom_columns(geoms)}};
}

}  // namespace pbmpi::app
