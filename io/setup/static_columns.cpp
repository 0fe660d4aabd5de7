#include "io/setup/static_columns.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "io/hdf5/columns.h"
#include "io/setup/world_result_rows.h"

namespace pbmpi::io {
namespace {

void write_ranks(const FileRanks& ranks, ColumnFile file, const RunSetup& setup) {
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const OwnRows own{{{static_cast<hsize_t>(ranks.rank()), 1}}, static_cast<hsize_t>(ranks.size())};
  ColumnWriter columns(ranks, file, "/ranks", own);
  columns.numbers("rank", std::vector<std::int32_t>{ranks.rank()});
  columns.texts("host", {rank < setup.hosts.size() ? setup.hosts[rank] : "unknown"});
  columns.numbers("worlds_at_start",
                  std::vector<std::int32_t>{static_cast<std::int32_t>(setup.worlds.size())});
}

}  // namespace

ColumnWriter::ColumnWriter(const FileRanks& ranks, ColumnFile file, std::string group, OwnRows rows)
    : ranks_(ranks), file_(file), group_(std::move(group)), rows_(std::move(rows)) {}

void ColumnWriter::numbers(const std::string& name, const std::vector<double>& values,
                           const std::string& unit, const std::vector<hsize_t>& item) {
  write(name, number_type(H5T_NATIVE_DOUBLE), values.data(), item, unit);
}

void ColumnWriter::numbers(const std::string& name, const std::vector<std::int32_t>& values) {
  write(name, number_type(H5T_NATIVE_INT32), values.data(), {}, "");
}

void ColumnWriter::numbers(const std::string& name, const std::vector<std::int64_t>& values,
                           const std::vector<hsize_t>& item) {
  write(name, number_type(H5T_NATIVE_INT64), values.data(), item, "");
}

void ColumnWriter::texts(const std::string& name, const std::vector<std::string>& values,
                         std::size_t length) {
  if (length == 0) {
    for (const std::string& value : values) length = std::max(length, value.size());
    length =
        static_cast<std::size_t>(ranks_.max(std::max<std::int64_t>(static_cast<std::int64_t>(length), 1)));
  }
  std::string packed;
  for (const std::string& value : values) {
    std::string padded = cut_text(value, length);
    padded.resize(length, '\0');
    packed += padded;
  }
  write(name, text_type(length), packed.data(), {}, "");
}

void ColumnWriter::write(const std::string& name, const Datatype& type, const void* data,
                         const std::vector<hsize_t>& item, const std::string& unit) {
  std::vector<hsize_t> dims{rows_.num_rows};
  hsize_t local = count_items(rows_.ranges);
  for (const hsize_t extent : item) {
    dims.push_back(extent);
    local *= extent;
  }
  const std::string path = group_ + "/" + name;
  if (file_.is_new) {
    ranks_.together([&] {
      if (ranks_.is_root()) create_fixed(file_.id, path, type, dims, unit);
    });
    return;
  }
  ranks_.together([&] {
    if (local == 0) return;
    const auto dataset =
        owned<Dataset>(H5Dopen2(file_.id, path.c_str(), H5P_DEFAULT), "H5Dopen(" + path + ")");
    const auto in_file = owned<Dataspace>(H5Dget_space(dataset.id()), "H5Dget_space");
    select_ranges(in_file, rows_.ranges);
    const auto in_memory = owned<Dataspace>(H5Screate_simple(1, &local, nullptr), "H5Screate_simple");
    check(H5Dwrite(dataset.id(), type.id(), in_memory.id(), in_file.id(), H5P_DEFAULT, data),
          "H5Dwrite(" + path + ")");
  });
}

void append(std::vector<double>& values, const core::Vec3& v) {
  values.insert(values.end(), {v[0], v[1], v[2]});
}

void append(std::vector<double>& values, const core::Quat& q) {
  values.insert(values.end(), {q.w, q.x, q.y, q.z});
}

void append(std::vector<double>& values, const core::Mat3& m) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) values.push_back(m(row, column));
  }
}

void append(std::vector<double>& values, const std::array<double, 3>& numbers) {
  values.insert(values.end(), numbers.begin(), numbers.end());
}

std::vector<std::int64_t> offsets(const FileRanks& ranks, const RunSetup& setup,
                                  const std::function<std::size_t(const model::Model&)>& count) {
  std::vector<std::int64_t> offset(static_cast<std::size_t>(setup.table.num_worlds()) + 1, 0);
  for (const stepping::LocalWorld& local : setup.worlds)
    offset[local.id + 1] = static_cast<std::int64_t>(count(*local.model));
  ranks.sum(offset);
  for (std::size_t w = 1; w < offset.size(); ++w) offset[w] += offset[w - 1];
  return offset;
}

OwnRows rows_in_world_order(const FileRanks& ranks, const RunSetup& setup,
                            const std::function<std::size_t(const model::Model&)>& count) {
  const std::vector<std::int64_t> offset = offsets(ranks, setup, count);
  OwnRows own;
  for (const stepping::LocalWorld& local : setup.worlds)
    append_range(own.ranges, static_cast<hsize_t>(offset[local.id]), count(*local.model));
  own.num_rows = static_cast<hsize_t>(offset.back());
  return own;
}

std::int64_t estimate_static_bytes(const RunShape& shape) {
  constexpr std::int64_t body_bytes = 160 + 120, geom_bytes = 150, joint_bytes = 440, world_bytes = 108;
  return shape.num_bodies * body_bytes + shape.num_geoms * geom_bytes + shape.num_joints * joint_bytes +
         shape.num_worlds * (world_bytes + bytes_of_a_world_result());
}

void write_static_columns(const FileRanks& ranks, ColumnFile file, const RunSetup& setup) {
  write_bodies(ranks, file, setup);
  write_geoms(ranks, file, setup);
  write_pair_materials(ranks, file, setup);
  write_joints(ranks, file, setup);
  write_connectivity(ranks, file, setup);
  write_worlds(ranks, file, setup);
  write_world_parameters(ranks, file, setup);
  write_ranks(ranks, file, setup);
}

}  // namespace pbmpi::io
