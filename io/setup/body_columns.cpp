/// The contents of a world: /particles/bodies, /geoms, /pair_materials.
#include <algorithm>

#include "io/setup/static_columns.h"
#include "model/names.h"

namespace pbmpi::io {
namespace {

using stepping::LocalWorld;

}  // namespace

void write_bodies(const FileRanks& ranks, hid_t file, const RunSetup& setup) {
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> world, local_body;
  std::vector<std::string> name, actor, kind, shape;
  std::vector<double> mass, inertia, size, position, orientation, velocity, spin;
  for (const LocalWorld& local : setup.worlds) {
    const model::Model& m = *local.model;
    for (int b = 0; b < m.num_bodies(); ++b) {
      const model::Body& body = m.bodies[b];
      const auto geom =
          std::find_if(m.geoms.begin(), m.geoms.end(), [b](const auto& g) { return g.body == b; });
      const bool has_geom = geom != m.geoms.end();
      id.push_back(setup.table.body_offset[local.id] + b);
      world.push_back(local.id);
      local_body.push_back(b);
      name.push_back(body.name);
      actor.push_back(m.actors[body.actor].name);
      kind.emplace_back(name_of(m.actors[body.actor].kind));
      mass.push_back(body.mass_kg);
      append(inertia, body.inertia);
      shape.emplace_back(has_geom ? name_of(geom->shape) : "none");
      append(size, has_geom ? geom->size : std::array<double, 3>{});
      append(position, body.pose.position);
      append(orientation, body.pose.orientation);
      append(velocity, body.velocity);
      append(spin, body.angular_velocity);
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
  columns.numbers("initial_position", position, "m", {3});
  columns.numbers("initial_orientation", orientation, "", {4});
  columns.numbers("initial_velocity", velocity, "m s-1", {3});
  columns.numbers("initial_angular_velocity", spin, "rad s-1", {3});
}

void write_geoms(const FileRanks& ranks, hid_t file, const RunSetup& setup) {
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

void write_pair_materials(const FileRanks& ranks, hid_t file, const RunSetup& setup) {
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
