/// The contents of a world: /particles/bodies, /geoms, /pair_materials.
#include <array>
#include <span>
#include <vector>

#include "io/setup/static_columns.h"
#include "model/names.h"
#include "model/state_parts.h"

namespace pbmpi::io {
namespace {

using stepping::LocalWorld;

/// [num_bodies] The first geom of each body, or none.
std::vector<const model::Geom*> first_geoms(const model::Model& model) {
  std::vector<const model::Geom*> geoms(model.bodies.size(), nullptr);
  for (const model::Geom& geom : model.geoms) {
    if (geom.body != model::no_body && geoms[geom.body] == nullptr) geoms[geom.body] = &geom;
  }
  return geoms;
}

}  // namespace

void write_bodies(const FileRanks& ranks, ColumnFile file, const RunSetup& setup) {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> world, local_body;
  std::vector<std::string> name, actor, kind, shape;
  std::vector<double> mass, inertia, size;
  std::array<std::vector<double>, model::body_columns.size()> initial;
  for (const LocalWorld& local : setup.worlds) {
    const model::Model& m = *local.model;
    const std::vector<const model::Geom*> geoms = first_geoms(m);
    for (int b = 0; b < m.num_bodies(); ++b) {
      const model::Body& body = m.bodies[b];
      const model::Geom* geom = geoms[b];
      id.push_back(setup.table.body_offset[local.id] + b);
      world.push_back(local.id);
      local_body.push_back(b);
      name.push_back(body.name);
      actor.push_back(m.actors[body.actor].name);
      kind.emplace_back(name_of(m.actors[body.actor].kind));
      mass.push_back(body.mass_kg);
      append(inertia, body.inertia);
      shape.emplace_back(geom != nullptr ? name_of(geom->shape) : "none");
      append(size, geom != nullptr ? geom->size : std::array<double, 3>{});
    }
    const model::State start = model::initial_state(m);
    for (std::size_t i = 0; i < initial.size(); ++i) {
      const std::span<const double> numbers = model::body_columns[i].of(start);
      initial[i].insert(initial[i].end(), numbers.begin(), numbers.end());
    }
  }
  ColumnWriter columns(ranks, file, "/particles/bodies",
                       rows_in_world_order(ranks, setup, [](const auto& m) { return m.bodies.size(); }));
  columns.numbers("id", id);
  columns.numbers("world", world);
  columns.numbers("local_body", local_body);
  columns.texts("name", name);
  columns.texts("actor", actor);
  columns.texts("kind", kind, longest(model::actor_kind_names));
  columns.numbers("mass", mass, "kg");
  columns.numbers("inertia", inertia, "kg m2", {3, 3});
  columns.texts("shape", shape, longest(model::shape_names));
  columns.numbers("shape_size", size, "m", {3});
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const model::BodyColumn& column = model::body_columns[i];
    columns.numbers(std::string("initial_") + column.name, initial[i], column.unit, {column.width()});
  }
}

void write_geoms(const FileRanks& ranks, ColumnFile file, const RunSetup& setup) {
  std::vector<std::int64_t> body;
  std::vector<std::int32_t> world;
  std::vector<std::string> actor, kind, shape;
  std::vector<double> size, position, orientation, mu, restitution;
  for (const LocalWorld& local : setup.worlds) {
    const model::Model& m = *local.model;
    for (const model::Geom& geom : m.geoms) {
      world.push_back(local.id);
      body.push_back(geom.body == model::no_body ? -1 : setup.table.body_offset[local.id] + geom.body);
      actor.push_back(m.actors[geom.actor].name);
      kind.emplace_back(name_of(m.actors[geom.actor].kind));
      shape.emplace_back(name_of(geom.shape));
      append(size, geom.size);
      append(position, geom.local.position);
      append(orientation, geom.local.orientation);
      mu.push_back(geom.material.mu);
      restitution.push_back(geom.material.restitution);
    }
  }
  ColumnWriter columns(ranks, file, "/geoms",
                       rows_in_world_order(ranks, setup, [](const auto& m) { return m.geoms.size(); }));
  columns.numbers("world", world);
  columns.numbers("body", body);
  columns.texts("actor", actor);
  columns.texts("kind", kind, longest(model::actor_kind_names));
  columns.texts("shape", shape, longest(model::shape_names));
  columns.numbers("size", size, "m", {3});
  columns.numbers("position", position, "m", {3});
  columns.numbers("orientation", orientation, "", {4});
  columns.numbers("mu", mu);
  columns.numbers("restitution", restitution);
}

void write_pair_materials(const FileRanks& ranks, ColumnFile file, const RunSetup& setup) {
  std::vector<std::int32_t> world;
  std::vector<std::string> actor_a, actor_b;
  std::vector<double> mu, restitution;
  for (const LocalWorld& local : setup.worlds) {
    for (const model::PairMaterial& pair : local.model->pair_materials) {
      world.push_back(local.id);
      actor_a.push_back(local.model->actors[pair.actor_a].name);
      actor_b.push_back(local.model->actors[pair.actor_b].name);
      mu.push_back(pair.material.mu);
      restitution.push_back(pair.material.restitution);
    }
  }
  ColumnWriter columns(ranks, file, "/pair_materials", rows_in_world_order(ranks, setup, [](const auto& m) {
                         return m.pair_materials.size();
                       }));
  columns.numbers("world", world);
  columns.texts("actor_a", actor_a);
  columns.texts("actor_b", actor_b);
  columns.numbers("mu", mu);
  columns.numbers("restitution", restitution);
}

}  // namespace pbmpi::io
