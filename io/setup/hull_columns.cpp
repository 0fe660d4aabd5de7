/// The surfaces of hulls: /hulls, and /geoms/hull.
#include <map>

#include "io/setup/static_columns.h"

namespace pbmpi::io {
namespace {

/// The first geom of a world with each of its hulls, ascending.
std::vector<int> first_geoms_with_hulls(const model::Model& model) {
  std::map<const model::Hull*, int> first;
  std::vector<int> geoms;
  for (int geom = 0; geom < static_cast<int>(model.geoms.size()); ++geom) {
    const model::Hull* hull = model.geoms[static_cast<std::size_t>(geom)].hull.get();
    if (hull != nullptr && first.emplace(hull, geom).second) geoms.push_back(geom);
  }
  return geoms;
}

std::size_t count_triangles(const model::Model& model) {
  std::size_t count = 0;
  for (const int geom : first_geoms_with_hulls(model)) {
    const model::Hull& hull = *model.geoms[static_cast<std::size_t>(geom)].hull;
    count += hull.corners.size() - 2 * hull.faces.size();
  }
  return count;
}

void append_triangles(const model::Hull& hull, std::vector<double>& corners) {
  for (const model::Hull::Face& face : hull.faces) {
    for (int i = 1; i + 1 < face.count; ++i) {
      for (const int corner : {0, i, i + 1}) {
        const int vertex = hull.corners[static_cast<std::size_t>(face.first + corner)];
        append(corners, hull.vertices[static_cast<std::size_t>(vertex)]);
      }
    }
  }
}

}  // namespace

void write_hulls(const FileRanks& ranks, ColumnFile file, const RunSetup& setup) {
  OwnRows rows = rows_in_world_order(ranks, setup, count_triangles);
  if (rows.num_rows == 0) return;
  const auto num_geoms = [](const model::Model& m) { return m.geoms.size(); };
  const std::vector<std::int64_t> offset = offsets(ranks, setup, num_geoms);
  std::vector<std::int64_t> first_with, geom;
  std::vector<double> corners;
  for (const stepping::LocalWorld& local : setup.worlds) {
    const model::Model& m = *local.model;
    std::map<const model::Hull*, std::int64_t> row_of{{nullptr, -1}};
    for (const int index : first_geoms_with_hulls(m)) {
      const model::Hull& hull = *m.geoms[static_cast<std::size_t>(index)].hull;
      const std::int64_t row = offset[static_cast<std::size_t>(local.id)] + index;
      row_of.emplace(&hull, row);
      append_triangles(hull, corners);
      geom.resize(corners.size() / 9, row);
    }
    for (const model::Geom& one : m.geoms) first_with.push_back(row_of.at(one.hull.get()));
  }
  ColumnWriter geoms(ranks, file, "/geoms", rows_in_world_order(ranks, setup, num_geoms));
  geoms.numbers("hull", first_with);
  ColumnWriter hulls(ranks, file, "/hulls", std::move(rows));
  hulls.numbers("geom", geom);
  hulls.numbers("corners", corners, "m", {3, 3});
}

}  // namespace pbmpi::io
