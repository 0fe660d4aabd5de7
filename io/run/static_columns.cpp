#include "io/run/static_columns.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "io/hdf5/columns.h"
#include "io/hdf5/rows.h"
#include "model/names.h"
#include "stepping/names.h"

namespace pbmpi::io {
namespace {

using stepping::LocalWorld;
using stepping::WorldTable;

template <std::size_t N>
constexpr std::size_t longest(const std::array<std::string_view, N>& names) {
  std::size_t length = 1;
  for (const std::string_view name : names) length = std::max(length, name.size());
  return length;
}

/// Writes columns of one group: this rank has the rows of `ranges`, in order.
class ColumnWriter {
 public:
  ColumnWriter(const FileRanks& ranks, hid_t file, std::string group, std::vector<Range> ranges,
               hsize_t num_rows)
      : ranks_(ranks),
        file_(file),
        group_(std::move(group)),
        ranges_(std::move(ranges)),
        num_rows_(num_rows),
        transfer_(collective_transfer()) {}

  void numbers(const std::string& name, const std::vector<double>& values, hsize_t width = 1,
               const std::string& unit = "") {
    write(name, number_type(H5T_NATIVE_DOUBLE), values.data(), width, unit);
  }
  void numbers(const std::string& name, const std::vector<std::int32_t>& values) {
    write(name, number_type(H5T_NATIVE_INT32), values.data(), 1, "");
  }
  void numbers(const std::string& name, const std::vector<std::int64_t>& values) {
    write(name, number_type(H5T_NATIVE_INT64), values.data(), 1, "");
  }
  /// `length` bytes each; 0 = as many as the longest on any rank.
  void texts(const std::string& name, const std::vector<std::string>& values, std::size_t length = 0) {
    if (length == 0) {
      for (const std::string& value : values) length = std::max(length, value.size());
      length =
          static_cast<std::size_t>(ranks_.max(std::max<std::int64_t>(static_cast<std::int64_t>(length), 1)));
    }
    std::string packed;
    for (const std::string& value : values) {
      packed += cut_text(value, length);
      packed.resize((packed.size() + length - 1) / length * length);
      if (value.empty()) packed.append(length, '\0');
    }
    write(name, text_type(length), packed.data(), 1, "");
  }

 private:
  void write(const std::string& name, const Datatype& type, const void* data, hsize_t width,
             const std::string& unit) {
    std::vector<hsize_t> dims{num_rows_};
    if (width > 1) dims.push_back(width);
    const Dataset dataset = create_fixed(file_, group_ + "/" + name, type, dims, unit);
    const auto in_file = owned<Dataspace>(H5Dget_space(dataset.id()), "H5Dget_space");
    select_ranges(in_file, ranges_);
    const hsize_t local = count_items(ranges_) * width;
    const hsize_t length = std::max<hsize_t>(local, 1);
    const auto in_memory = owned<Dataspace>(H5Screate_simple(1, &length, nullptr), "H5Screate_simple");
    if (local == 0) check(H5Sselect_none(in_memory.id()), "H5Sselect_none");
    check(H5Dwrite(dataset.id(), type.id(), in_memory.id(), in_file.id(), transfer_.id(), data),
          "H5Dwrite(" + group_ + "/" + name + ")");
  }

  const FileRanks& ranks_;
  hid_t file_;
  std::string group_;
  std::vector<Range> ranges_;
  hsize_t num_rows_;
  PropertyList transfer_;
};

void append(std::vector<double>& values, const core::Vec3& v) {
  values.insert(values.end(), {v[0], v[1], v[2]});
}

void append(std::vector<double>& values, const core::Quat& q) {
  values.insert(values.end(), {q.w, q.x, q.y, q.z});
}

void append(std::vector<double>& values, const std::array<double, 3>& size) {
  values.insert(values.end(), size.begin(), size.end());
}

void write_bodies(const FileRanks& ranks, hid_t file, const RunSetup& setup) {
  const WorldTable& table = setup.table;
  std::vector<Range> ranges;
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> world, local_body;
  std::vector<std::string> name, actor, kind, shape;
  std::vector<double> mass, size, position, orientation;
  for (const LocalWorld& local : setup.worlds) {
    const model::Model& m = *local.model;
    const std::int64_t offset = table.body_offset[local.id];
    append_range(ranges, static_cast<hsize_t>(offset), m.bodies.size());
    for (int b = 0; b < m.num_bodies(); ++b) {
      const model::Body& body = m.bodies[b];
      const auto geom =
          std::find_if(m.geoms.begin(), m.geoms.end(), [b](const auto& g) { return g.body == b; });
      const bool has_geom = geom != m.geoms.end();
      id.push_back(offset + b);
      world.push_back(local.id);
      local_body.push_back(b);
      name.push_back(body.name);
      actor.push_back(m.actors[body.actor].name);
      kind.emplace_back(name_of(m.actors[body.actor].kind));
      mass.push_back(body.mass_kg);
      shape.emplace_back(has_geom ? name_of(geom->shape) : "none");
      append(size, has_geom ? geom->size : std::array<double, 3>{});
      append(position, body.pose.position);
      append(orientation, body.pose.orientation);
    }
  }
  ColumnWriter columns(ranks, file, "/particles/bodies", ranges, static_cast<hsize_t>(table.num_bodies()));
  columns.numbers("id", id);
  columns.numbers("world", world);
  columns.numbers("local_body", local_body);
  columns.texts("name", name);
  columns.texts("actor", actor);
  columns.texts("kind", kind, longest(model::actor_kind_names));
  columns.numbers("mass", mass, 1, "kg");
  columns.texts("shape", shape, longest(model::shape_names));
  columns.numbers("shape_size", size, 3, "m");
  columns.numbers("initial_position", position, 3, "m");
  columns.numbers("initial_orientation", orientation, 4);
}

/// [num_worlds + 1] where the geoms of each world begin.
std::vector<std::int64_t> geom_offsets(const FileRanks& ranks, const RunSetup& setup) {
  std::vector<std::int64_t> offset(static_cast<std::size_t>(setup.table.num_worlds()) + 1, 0);
  for (const LocalWorld& local : setup.worlds) {
    offset[local.id + 1] = static_cast<std::int64_t>(local.model->geoms.size());
  }
  ranks.sum(offset);
  for (std::size_t w = 1; w < offset.size(); ++w) offset[w] += offset[w - 1];
  return offset;
}

void write_geoms(const FileRanks& ranks, hid_t file, const RunSetup& setup) {
  const std::vector<std::int64_t> offset = geom_offsets(ranks, setup);
  std::vector<Range> ranges;
  std::vector<std::int64_t> body;
  std::vector<std::int32_t> world;
  std::vector<std::string> kind, shape;
  std::vector<double> size, position, orientation;
  for (const LocalWorld& local : setup.worlds) {
    const model::Model& m = *local.model;
    append_range(ranges, static_cast<hsize_t>(offset[local.id]), m.geoms.size());
    for (const model::Geom& geom : m.geoms) {
      world.push_back(local.id);
      body.push_back(geom.body == model::no_body ? -1 : setup.table.body_offset[local.id] + geom.body);
      kind.emplace_back(name_of(m.actors[geom.actor].kind));
      shape.emplace_back(name_of(geom.shape));
      append(size, geom.size);
      append(position, geom.local.position);
      append(orientation, geom.local.orientation);
    }
  }
  ColumnWriter columns(ranks, file, "/geoms", ranges, static_cast<hsize_t>(offset.back()));
  columns.numbers("world", world);
  columns.numbers("body", body);
  columns.texts("kind", kind, longest(model::actor_kind_names));
  columns.texts("shape", shape, longest(model::shape_names));
  columns.numbers("size", size, 3, "m");
  columns.numbers("position", position, 3, "m");
  columns.numbers("orientation", orientation, 4);
}

void write_ranks(const FileRanks& ranks, hid_t file, const RunSetup& setup) {
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const std::vector<Range> own{{static_cast<hsize_t>(ranks.rank()), 1}};
  ColumnWriter columns(ranks, file, "/ranks", own, static_cast<hsize_t>(ranks.size()));
  columns.numbers("rank", std::vector<std::int32_t>{ranks.rank()});
  columns.texts("host", {rank < setup.hosts.size() ? setup.hosts[rank] : "unknown"});
  columns.numbers("worlds_at_start",
                  std::vector<std::int32_t>{static_cast<std::int32_t>(setup.worlds.size())});
}

}  // namespace

void write_static_columns(const FileRanks& ranks, hid_t file, const RunSetup& setup) {
  write_bodies(ranks, file, setup);
  write_geoms(ranks, file, setup);
  write_ranks(ranks, file, setup);
}

}  // namespace pbmpi::io
