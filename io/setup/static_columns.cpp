#include "io/setup/static_columns.h"

#include <vector>

namespace pbmpi::io {
namespace {

void write_ranks(const FileRanks& ranks, hid_t file, const RunSetup& setup) {
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const OwnRows own{{{static_cast<hsize_t>(ranks.rank()), 1}}, static_cast<hsize_t>(ranks.size())};
  ColumnWriter columns(ranks, file, "/ranks", own);
  columns.numbers("rank", std::vector<std::int32_t>{ranks.rank()});
  columns.texts("host", {rank < setup.hosts.size() ? setup.hosts[rank] : "unknown"});
  columns.numbers("worlds_at_start",
                  std::vector<std::int32_t>{static_cast<std::int32_t>(setup.worlds.size())});
}

}  // namespace

OwnRows rows_in_world_order(const FileRanks& ranks, const RunSetup& setup,
                            const std::function<std::size_t(const model::Model&)>& count) {
  std::vector<std::int64_t> counts(static_cast<std::size_t>(setup.table.num_worlds()), 0);
  for (const stepping::LocalWorld& local : setup.worlds)
    counts[local.id] = static_cast<std::int64_t>(count(*local.model));
  ranks.sum(counts);
  OwnRows own;
  auto world = setup.worlds.begin();
  for (std::size_t w = 0; w < counts.size(); ++w) {
    const auto rows = static_cast<hsize_t>(counts[w]);
    if (world != setup.worlds.end() && world->id == static_cast<int>(w)) {
      append_range(own.ranges, own.num_rows, rows);
      ++world;
    }
    own.num_rows += rows;
  }
  return own;
}

std::int64_t estimate_static_bytes(const RunShape& shape) {
  constexpr std::int64_t body_bytes = 160 + 120, geom_bytes = 150, joint_bytes = 420, world_bytes = 100;
  return shape.num_bodies * body_bytes + shape.num_geoms * geom_bytes + shape.num_joints * joint_bytes +
         shape.num_worlds * world_bytes;
}

void write_static_columns(const FileRanks& ranks, hid_t file, const RunSetup& setup) {
  write_bodies(ranks, file, setup);
  write_geoms(ranks, file, setup);
  write_pair_materials(ranks, file, setup);
  write_joints(ranks, file, setup);
  write_worlds(ranks, file, setup);
  write_ranks(ranks, file, setup);
}

}  // namespace pbmpi::io
