#include "io/rows.h"

#include <gtest/gtest.h>

#include <numeric>

namespace pbmpi::io::test {
namespace {

Dataspace space_of(const std::vector<hsize_t>& dims) {
  return owned<Dataspace>(H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr),
                          "H5Screate_simple");
}

hssize_t num_selected(const Dataspace& space) { return H5Sget_select_npoints(space.id()); }

TEST(Ranges, merges_neighbours_and_drops_empty_ones) {
  std::vector<Range> ranges;
  append_range(ranges, 3, 2);
  append_range(ranges, 5, 0);
  append_range(ranges, 5, 4);
  append_range(ranges, 10, 1);
  EXPECT_EQ(ranges, (std::vector<Range>{{3, 6}, {10, 1}}));
  EXPECT_EQ(count_items(ranges), 7u);
}

TEST(RowBlocks, selects_each_row_with_the_ranges_it_was_added_with) {
  RowBlocks blocks;
  blocks.add(2, {{0, 1}, {4, 2}});
  blocks.add(3, {{0, 1}, {4, 2}});
  blocks.add(4, {{1, 3}});
  const Dataspace space = space_of({6, 6, 3});
  blocks.select(space, 0);
  EXPECT_EQ(num_selected(space), (2 * 3 + 3) * 3);
  const hsize_t start[3] = {4, 1, 0}, count[3] = {1, 3, 3};
  ASSERT_GE(H5Sselect_hyperslab(space.id(), H5S_SELECT_AND, start, nullptr, count, nullptr), 0);
  EXPECT_EQ(num_selected(space), 9) << "row 4 has its own range";
}

TEST(RowBlocks, shifts_rows_for_the_buffer_in_memory) {
  RowBlocks blocks;
  blocks.add(7, {{0, 1}});
  const Dataspace space = space_of({2});
  blocks.select(space, 7);
  hsize_t low = 9, high = 9;
  ASSERT_GE(H5Sget_select_bounds(space.id(), &low, &high), 0);
  EXPECT_EQ(low, 0u);
  EXPECT_EQ(high, 0u);
}

TEST(RowBlocks, selects_nothing_for_a_rank_without_items) {
  RowBlocks blocks;
  blocks.add(0, {});
  const Dataspace space = space_of({4, 4});
  blocks.select(space, 0);
  EXPECT_EQ(num_selected(space), 0);
}

class ChunkShape : public testing::TestWithParam<std::vector<hsize_t>> {};

TEST_P(ChunkShape, has_1_to_4_mebibytes_or_the_whole_dataset_and_wastes_less_than_a_row_a_chunk) {
  const std::vector<hsize_t>& dims = GetParam();
  const std::vector<hsize_t> chunk = chunk_shape(dims, 8);
  const auto product = [](const std::vector<hsize_t>& v) {
    return std::accumulate(v.begin(), v.end(), hsize_t{8}, std::multiplies<>());
  };
  for (std::size_t d = 0; d < dims.size(); ++d) EXPECT_LE(chunk[d], std::max<hsize_t>(dims[d], 1));
  if (product(dims) > (hsize_t{1} << 20)) {
    EXPECT_GE(product(chunk), hsize_t{1} << 20);
  }
  EXPECT_LE(product(chunk), hsize_t{4} << 20);
  const hsize_t num_chunks = (dims[0] + chunk[0] - 1) / chunk[0];
  EXPECT_LT(num_chunks * chunk[0], dims[0] + num_chunks);
}

INSTANTIATE_TEST_SUITE_P(Sizes, ChunkShape,
                         testing::Values(std::vector<hsize_t>{8, 3700, 3},
                                         std::vector<hsize_t>{1000, 3700, 4}, std::vector<hsize_t>{1000000},
                                         std::vector<hsize_t>{1, 1, 3}, std::vector<hsize_t>{10, 1000000, 3},
                                         std::vector<hsize_t>{37, 9000, 3},
                                         std::vector<hsize_t>{100000, 100}));

}  // namespace
}  // namespace pbmpi::io::test
