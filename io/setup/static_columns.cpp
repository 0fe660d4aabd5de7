#include "io/setup/static_columns.h"

#include <vector>

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
  write_hulls(ranks, file, setup);
  write_pair_materials(ranks, file, setup);
  write_joints(ranks, file, setup);
  write_connectivity(ranks, file, setup);
  write_worlds(ranks, file, setup);
  write_world_parameters(ranks, file, setup);
  write_ranks(ranks, file, setup);
}

}  // namespace pbmpi::io
